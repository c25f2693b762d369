// Passes the land around the camera to the renderer for its light: a thread generates tiles
// (render/land/land_map.h), coarse ones first, and each frame passes on finished ones. Land is as generated:
// edits do not change light in the distance. WorldView uses it on the thread of the OpenGL context.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "terrane/game/session.h"
#include "terrane/render/frame/renderer.h"
#include "terrane/view/tile_maker.h"
#include "terrane/world/tint.h"

namespace terrane::view {

class LandView {
  public:
    // Most tiles that a frame passes on, some 3 ms in all: the thread makes as many in 60 ms.
    static constexpr std::size_t kTilesPerFrame = 128, kAllTiles = SIZE_MAX;

    // Both arguments outlive this.
    LandView(const game::Session& session, render::Renderer& renderer);

    // Passes up to `limit` tiles to the renderer, and requests those that are missing for a view of `reach`
    // blocks, if its options need them. With kAllTiles the next frame has the light of all tiles.
    void update(world::ChunkPos camera, double reach, std::size_t limit);
    // Returns the number of requested tiles not passed on yet, as of the last update().
    std::size_t missing() const { return maker_ ? maker_->pending() : 0; }
    // Blocks until a tile is finished, or the time is over.
    void wait(std::chrono::milliseconds timeout) {
        if (maker_) maker_->wait(timeout);
    }

  private:
    render::Renderer& renderer_;
    std::optional<TileMaker<world::LandTile>> maker_;
};

// Passes the tint around the camera to the renderer: a thread generates tiles (render/land/clipmap.h), near
// ones first, and each frame passes on finished ones. Does nothing if the generator has no tint. WorldView
// uses it on the thread of the OpenGL context.
class TintView {
  public:
    // Most tiles that a frame passes on: 1 KiB each, some 0.1 ms in all.
    static constexpr std::size_t kTilesPerFrame = 32, kAllTiles = SIZE_MAX;

    // Both arguments outlive this. The constructor sets in the renderer whether there is a tint.
    TintView(const game::Session& session, render::Renderer& renderer);

    // Passes up to `limit` tiles to the renderer, and requests those that are missing within `reach` blocks
    // of the camera.
    void update(world::ChunkPos camera, double reach, std::size_t limit);
    // Returns the number of requested tiles not passed on yet, as of the last update().
    std::size_t missing() const { return maker_ ? maker_->pending() : 0; }
    // Blocks until a tile is finished, or the time is over.
    void wait(std::chrono::milliseconds timeout) {
        if (maker_) maker_->wait(timeout);
    }

  private:
    const gen::LevelGenerators& generators_;
    render::Renderer& renderer_;
    std::optional<TileMaker<world::TintTile>> maker_;
};

}  // namespace terrane::view
