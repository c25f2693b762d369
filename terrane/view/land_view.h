// Brings the land around the camera to the renderer for its light: a thread asks the generator for tiles
// (render/land_map.h), coarse ones first, and each frame hands on what is finished. Land is as it was
// generated: edits change no light in the distance. Used by WorldView on the thread of the OpenGL context.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "terrane/game/session.h"
#include "terrane/render/renderer.h"
#include "terrane/view/tile_maker.h"
#include "terrane/world/land_tile.h"

namespace terrane::view {

class LandView {
  public:
    // Tiles that a frame hands on, together some 3 ms: the thread makes as many in 60 ms.
    static constexpr std::size_t kTilesAFrame = 128, kAllTiles = SIZE_MAX;

    // Both outlive this.
    LandView(const game::Session& session, render::Renderer& renderer);

    // Hands on up to `limit` tiles, and asks for those that are missing for a view of `reach` blocks. With
    // kAllTiles the next frame has the light of all of them.
    void update(world::ChunkPos camera, double reach, std::size_t limit);
    // As of the last update().
    std::size_t missing() const { return maker_ ? maker_->pending() : 0; }
    // Blocks until a tile is finished, or the time is over.
    void wait(std::chrono::milliseconds atMost) {
        if (maker_) maker_->wait(atMost);
    }

  private:
    render::Renderer& renderer_;
    std::optional<TileMaker<world::LandTile>> maker_;
};

}  // namespace terrane::view
