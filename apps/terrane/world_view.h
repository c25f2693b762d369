// What a frame does so that the world around its camera is on screen: asks for chunks, takes in what workers
// did, hands it to the renderer within a budget of time. Used on the thread of the OpenGL context.
#pragma once

#include <algorithm>

#include "apps/terrane/world_session.h"
#include "terrane/render/renderer.h"

namespace terrane::app {

// A frame's time for what workers finished: a quarter of what the last one took, so that loading makes no
// frame twice as long however fast the machine draws. A chunk takes about 0.25 ms: at 60 frames a second
// 1,000 chunks a second come on screen, and a flight at full speed with view distance 32 needs 350.
inline double uploadBudget(double frameSeconds) {
    return std::clamp(frameSeconds / 4, 0.001, 0.025);
}

class WorldView {
  public:
    // Both outlive this.
    WorldView(WorldSession& session, render::Renderer& renderer) : session_(session), renderer_(renderer) {}

    // Chunks up to `viewDistance` around the camera come, those in front of it first. Takes in what is there.
    void follow(const render::Camera& camera, int viewDistance);
    // Hands changed chunks to the renderer, at least one, until so much time is over; the rest waits for the
    // next frames. The first time that one finds no room there is a warning. How many it handed on.
    std::size_t upload(double budgetSeconds);

  private:
    void show(const stream::ChunkChange& change);

    WorldSession& session_;
    render::Renderer& renderer_;
    bool hasWarned_ = false;
};

// Waits until the renderer has everything that the camera may see, as it is now. `now`: the pipeline's time.
// Milliseconds that uploading took.
double loadAll(WorldSession& session, render::Renderer& renderer, const render::Camera& camera,
               int viewDistance, stream::ChunkPipeline::Time now);

}  // namespace terrane::app
