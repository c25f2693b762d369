// Puts land beyond the chunks on screen: hands tiles to the renderer, and has chunks and tiles shown so that
// each column is drawn once (stream/tile_table.h). Used by WorldView on the thread of the OpenGL context.
#pragma once

#include <chrono>

#include "terrane/game/session.h"
#include "terrane/render/renderer.h"

namespace terrane::view {

// How far tiles reach and how wide their rings are: see stream::TileView. In chunks.
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
    // A chunk comes to the renderer for the first time: it stays hidden until it can take a tile's place.
    void beforeChunk(world::ChunkPos pos);
    // It is there; or it was taken from the renderer.
    void setChunkReady(world::ChunkPos pos, bool isReady) { tiles_.setChunkReady(pos, isReady); }
    // The renderer forgot everything.
    void forgetAll() { tiles_.forgetAll(); }

    // Takes in finished tiles and gives out new work.
    void update() { tiles_.update(pipeline_.meshOptions().method); }
    // Hands tiles to the renderer until the deadline. False where there is no room for one.
    bool upload(std::chrono::steady_clock::time_point deadline);
    // Shows and hides what came and went. While tiles come, some times a second, unless something is gone.
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
