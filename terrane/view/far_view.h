// Shows land beyond the chunks: passes tiles to the renderer, and shows chunks and tiles so that each column
// is drawn once (stream/tile_table.h). Used by WorldView on the thread of the OpenGL context.
#pragma once

#include <chrono>

#include "terrane/game/session.h"
#include "terrane/render/frame/renderer.h"

namespace terrane::view {

// Distance of tiles and width of their rings, in chunks: see stream::TileView.
struct Horizon {
    int distance = 0;  // 0: no tiles
    int detail = 12;

    bool operator==(const Horizon&) const = default;
};

class FarView {
  public:
    // Both outlive this.
    FarView(game::Session& session, render::Renderer& renderer)
        : tiles_(session.tiles()), pipeline_(session.pipeline()), renderer_(renderer) {}

    void setView(world::ChunkPos center, int viewDistance, const Horizon& horizon);
    // Comes before the renderer gets a chunk for the first time: the chunk stays hidden until it can replace
    // a tile.
    void beforeChunk(world::ChunkPos pos);
    // The chunk is complete in the renderer, or was removed from it.
    void setChunkReady(world::ChunkPos pos, bool isReady) { tiles_.setChunkReady(pos, isReady); }
    // The renderer has removed all chunks and tiles.
    void forgetAll() { tiles_.forgetAll(); }

    // Receives finished tiles and submits new work.
    void update() { tiles_.update(pipeline_.meshOptions().method); }
    // Passes tiles to the renderer until the deadline. False if there is no room for one.
    bool upload(std::chrono::steady_clock::time_point deadline);
    // Shows new tiles and hides replaced ones. While tiles load, at most every 15 ms, unless a shown one is
    // gone.
    void applyChanges();
    // The same at once.
    void applyNow();

    std::size_t missing() const { return tiles_.missing(); }

  private:
    stream::TilePipeline& tiles_;
    const stream::ChunkPipeline& pipeline_;
    render::Renderer& renderer_;
    std::chrono::steady_clock::time_point nextChanges_{};
};

}  // namespace terrane::view
