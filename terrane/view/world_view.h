// Shows the world around the camera: in each frame it requests chunks, receives finished ones and passes them
// to the renderer within a time budget and the renderer's memory budget. It is used on the thread of the
// OpenGL context.
//
// If a chunk does not fit the memory budget, the view gets shorter (gpu_back_ends.h) until it does, and the
// farthest chunks are removed. The view stays short until another view distance is set, so that it does not
// oscillate.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "terrane/game/session.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/mesh_gpu/mesh_queue.h"
#include "terrane/render/frame/renderer.h"
#include "terrane/view/far_view.h"
#include "terrane/view/land_view.h"

namespace terrane::view {

// Returns the time for uploads in a frame, as a share of the last frame's time, so that loading makes no
// frame much longer on any machine: a sixteenth, and up to a quarter if all of the view is `missing`. A chunk
// takes about 0.1 ms: at 60 frames a second 600 chunks a second appear on screen, and a flight at full speed
// with view distance 32 needs 350.
inline double uploadBudget(double frameSeconds, double missing) {
    return std::clamp(frameSeconds * std::clamp(missing / 4, 1.0 / 16, 1.0 / 4), 0.001, 0.025);
}

// Returns the share of a view that is not up to date on screen, 0 to 1: chunks that are not visible yet, and
// changes that wait for the renderer.
inline double missingShare(const stream::Progress& progress, std::size_t waitingChanges) {
    const auto wanted = static_cast<double>(std::max<std::size_t>(progress.inView, 1));
    const auto missing = static_cast<double>(progress.inView - progress.visible + waitingChanges);
    return std::min(1.0, missing / wanted);
}

class WorldView {
  public:
    // Time for meshing on the GPU in a frame; kNoLimit: no limit.
    static constexpr double kFrameMilliseconds = 3, kNoLimit = 0;

    // Both arguments outlive this.
    WorldView(game::Session& session, render::Renderer& renderer)
        : session_(session),
          renderer_(renderer),
          far_(session, renderer),
          tints_(session, renderer),
          land_(session, renderer),
          shown_(shownParts()) {
        renderer.setHeights(session.world().heights());
        renderer.setAirLevels(gen::airLevelsOf(session.store().identity().generator));
        if (!shown_.quads) session.pipeline().setMeshing(stream::MeshPolicy::Caller);
    }

    // Meshes whole chunks on the GPU, within a time budget for each frame, for a session whose pipeline
    // leaves them to its caller (stream::MeshPolicy). Call it before the first upload.
    base::Result<void> meshOnGpu(const gpu::ShaderLoader& shaders, double budgetMilliseconds);

    // Requests chunks up to `viewDistance` around the camera, or as far as memory allows, those in the view
    // direction first. Receives finished chunks.
    void follow(const render::Camera& camera, int viewDistance);
    // Does the same without receiving chunks. `direction`: see stream::ViewOrder.
    void setView(world::ChunkPos center, int viewDistance, glm::vec2 direction = {});
    // Makes deep ground only near the camera and where it is open (stream/depth.h), from now on.
    void setCameraHeight(const render::Camera& camera);
    // Sets the distance of land beyond the chunks, from the next setView() or follow() on.
    void setHorizon(const Horizon& horizon);
    // Returns the requested view distance, or a smaller one that memory allows.
    int viewDistance() const { return viewDistance_; }
    // Returns the farthest visible distance in chunks: the horizon, or the view distance.
    int visibleDistance() const { return std::max(viewDistance_, horizon_.distance); }
    // Passes changed chunks to the renderer, at least one, until the time is over; the rest waits for the
    // next frames. Returns their number.
    std::size_t upload(double budgetSeconds);
    // Returns a message that the view is shorter than requested, once, when the shorter view is on screen; it
    // is logged too.
    std::optional<std::string> takeNotice() { return std::exchange(notice_, std::nullopt); }
    double missing() const {
        return missingShare(session_.pipeline().progress(), session_.pipeline().waitingChanges());
    }
    // Returns the number of chunks that wait for the GPU to mesh them.
    std::size_t waiting() const { return queue_ ? queue_->size() : 0; }
    // Receives the tiles that workers finished, as follow() does.
    void updateTiles() { far_.update(); }
    // Returns the number of tiles that are not on screen yet.
    std::size_t missingTiles() const { return far_.missing(); }
    // Returns the number of requested tiles of the tint and of the land.
    std::size_t missingClipmapTiles() const { return tints_.missing() + land_.missing(); }
    // Blocks until workers may have finished something, or the time is over.
    void waitForWorkers(std::chrono::milliseconds timeout);

  private:
    // What the renderer reads of chunks and tiles.
    struct ShownParts {
        bool quads = true, blocks = false;
        bool operator==(const ShownParts&) const = default;
    };
    ShownParts shownParts() const { return {renderer_.readsQuads(), renderer_.readsBlocks()}; }
    void updateShownParts();
    void show(const stream::ChunkChange& change);
    template <class Set>
    bool makeRoomFor(world::ChunkPos pos, const Set& set);
    bool shortenView();
    bool shortenHorizon();
    void moveView();
    void keepWithinBudget();
    void showAgain();
    void noticeShortView();
    void hide(world::ChunkPos pos);
    void advanceQueue();
    void writeMeshes();
    void countMeshes();
    void warnOfNoRoom(world::ChunkPos pos);

    game::Session& session_;
    render::Renderer& renderer_;
    FarView far_;
    TintView tints_;
    LandView land_;
    Horizon requestedHorizon_, horizon_;  // horizon_: what memory allows of it
    std::optional<mesh_gpu::MeshQueue> queue_;
    world::ChunkPos center_;
    glm::vec2 direction_{};
    int requestedDistance_ = -1, viewDistance_ = -1;  // chunks; -1: no view yet
    std::size_t fixedBytes_ = 0;                      // when all chunks were removed last
    bool hasWarned_ = false, hasNoticed_ = false;
    ShownParts shown_;  // as of the last upload
    std::optional<std::string> notice_;
};

// Waits until the renderer has everything in view of the camera in its current state, as far as memory allows
// (see WorldView::viewDistance()). `now` is the pipeline's time. Returns the milliseconds that uploading
// took.
double loadAll(game::Session& session, WorldView& view, const render::Camera& camera, int viewDistance,
               stream::ChunkPipeline::Time now);

}  // namespace terrane::view
