// Supplies the renderer with the tint around the camera: a thread generates tiles (render/clipmap.h), near
// ones first, and each frame passes on finished ones. Does nothing if the generator has no tint. Used by
// WorldView on the thread of the OpenGL context.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "terrane/game/session.h"
#include "terrane/render/renderer.h"
#include "terrane/view/tile_maker.h"
#include "terrane/world/tint.h"

namespace terrane::view {

class TintView {
  public:
    // Most tiles that a frame passes on: 1 KiB each, some 0.1 ms in all.
    static constexpr std::size_t kTilesAFrame = 32, kAllTiles = SIZE_MAX;

    // Both outlive this. Tells the renderer whether there is a tint.
    TintView(const game::Session& session, render::Renderer& renderer);

    // Passes up to `limit` tiles to the renderer, and requests those that are missing within `reach` blocks
    // of the camera.
    void update(world::ChunkPos camera, double reach, std::size_t limit);
    // Requested tiles not passed on yet, as of the last update().
    std::size_t missing() const { return maker_ ? maker_->pending() : 0; }
    // Blocks until a tile is finished, or the time is over.
    void wait(std::chrono::milliseconds atMost) {
        if (maker_) maker_->wait(atMost);
    }

  private:
    const gen::LevelGenerators& generators_;
    render::Renderer& renderer_;
    std::optional<TileMaker<world::TintTile>> maker_;
};

}  // namespace terrane::view
