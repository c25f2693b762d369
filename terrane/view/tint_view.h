// Brings the tint around the camera to the renderer: a thread asks the generator for tiles (render/
// tint_clipmap.h), near ones first, and each frame hands on what is finished. Does nothing where the
// generator has no tint. Used by WorldView on the thread of the OpenGL context.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <unordered_set>
#include <utility>
#include <vector>

#include "terrane/game/session.h"
#include "terrane/render/renderer.h"
#include "terrane/world/tint.h"

namespace terrane::view {

class TintView {
  public:
    // Tiles that a frame hands on: 1 KiB each, together some 0.1 ms.
    static constexpr std::size_t kTilesAFrame = 32, kAllTiles = SIZE_MAX;

    // Both outlive this. Tells the renderer whether there is a tint.
    TintView(const game::Session& session, render::Renderer& renderer);
    ~TintView();
    TintView(const TintView&) = delete;
    TintView& operator=(const TintView&) = delete;

    // Hands on up to `limit` tiles, and asks for those that are missing within `reach` blocks of the camera.
    void update(world::ChunkPos camera, double reach, std::size_t limit);
    // As of the last update().
    std::size_t missing() const { return requested_.size(); }
    // Blocks until a tile is finished, or the time is over.
    void wait(std::chrono::milliseconds atMost);

  private:
    using Tile = std::pair<world::ChunkPos, world::TintTile>;
    void run();
    std::vector<Tile> takeFinished(std::size_t limit);

    const gen::LevelGenerators& generators_;
    render::Renderer& renderer_;
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> requested_;  // until the renderer has them

    std::mutex mutex_;  // of all below
    std::condition_variable hasWork_, hasFinished_;
    std::deque<world::ChunkPos> waiting_;
    std::deque<Tile> finished_;
    bool isEnding_ = false;
    std::jthread thread_;  // ends first
};

}  // namespace terrane::view
