// Shows land beyond the chunks: passes tiles to the renderer, and shows chunks and tiles so that each column
// is drawn once (stream/tile_table.h). WorldView uses it on the thread of the OpenGL context.
#pragma once

#include <chrono>
#include <optional>

#include "terrane/game/session.h"
#include "terrane/render/frame/renderer.h"

namespace terrane::view {

// The distance of tiles and the width of their rings, in chunks: see stream::TileView.
struct Horizon {
    int distance = 0;  // 0: no tiles
    int detail = 12;

    bool operator==(const Horizon&) const = default;
};

class FarView {
  public:
    // Both arguments outlive this.
    FarView(game::Session& session, render::Renderer& renderer)
        : tiles_(session.tiles()), pipeline_(session.pipeline()), renderer_(renderer) {}

    void setView(world::ChunkPos center, int viewDistance, const Horizon& horizon);
    // Call this before the renderer gets a chunk for the first time: the chunk stays hidden until it can
    // replace a tile.
    void prepareChunk(world::ChunkPos pos);
    // Sets whether the chunk is complete in the renderer; false after it was removed.
    void setChunkReady(world::ChunkPos pos, bool isReady) { tiles_.setChunkReady(pos, isReady); }
    // Call this after the renderer has removed all chunks and tiles.
    void invalidateAll() { tiles_.invalidateAll(); }

    // Receives finished tiles and submits new work.
    void update() {
        tiles_.update(renderer_.readsQuads() ? std::optional(pipeline_.meshOptions().method) : std::nullopt);
    }
    // Passes tiles to the renderer until the deadline. Returns false if there is no room for one.
    bool upload(std::chrono::steady_clock::time_point deadline);
    // Shows new tiles and hides replaced ones. While tiles load, it works at most every 15 ms, unless a shown
    // tile was removed.
    void applyChanges();
    // Does the same at once.
    void applyNow();

    std::size_t missing() const { return tiles_.missing(); }

  private:
    stream::TilePipeline& tiles_;
    const stream::ChunkPipeline& pipeline_;
    render::Renderer& renderer_;
    std::chrono::steady_clock::time_point nextChanges_{};
};

}  // namespace terrane::view
