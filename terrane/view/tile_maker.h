// A thread that makes tiles of a clipmap (render/land/clipmap.h) one after the other. It is used by views of
// the tint and of the land on the thread of the OpenGL context.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <unordered_set>
#include <utility>
#include <vector>

#include "terrane/world/coords.h"

namespace terrane::view {

template <class T>
class TileMaker {
  public:
    using Tile = std::pair<world::ChunkPos, T>;

    // `maxRequested` limits the tiles requested at once; with fewer tiles the thread follows a moving camera
    // sooner. Throws std::system_error if no thread can be started. `make` is called by the thread and throws
    // nothing.
    TileMaker(std::size_t maxRequested, std::function<T(world::ChunkPos)> make)
        : maxRequested_(maxRequested), make_(std::move(make)), thread_([this] { run(); }) {}
    ~TileMaker() {
        const std::lock_guard lock(mutex_);
        isEnding_ = true;
        hasWork_.notify_all();
    }
    TileMaker(const TileMaker&) = delete;
    TileMaker& operator=(const TileMaker&) = delete;

    // Requests the tiles that are not requested yet, up to the limit.
    void request(const std::vector<world::ChunkPos>& tiles) {
        std::vector<world::ChunkPos> more;
        for (const world::ChunkPos tile : tiles) {
            if (requested_.size() == maxRequested_) break;
            if (requested_.insert(tile).second) more.push_back(tile);
        }
        if (more.empty()) return;
        const std::lock_guard lock(mutex_);
        waiting_.insert(waiting_.end(), more.begin(), more.end());
        hasWork_.notify_all();
    }
    std::vector<Tile> takeFinished(std::size_t limit) {
        const std::lock_guard lock(mutex_);
        const auto end = finished_.begin() + static_cast<std::ptrdiff_t>(std::min(limit, finished_.size()));
        std::vector<Tile> tiles(finished_.begin(), end);
        finished_.erase(finished_.begin(), end);
        for (const Tile& tile : tiles) requested_.erase(tile.first);
        return tiles;
    }
    std::size_t maxRequested() const { return maxRequested_; }
    // Returns the number of tiles that are requested and not taken.
    std::size_t pending() const { return requested_.size(); }
    // Blocks until a tile is finished, or the time is over.
    void wait(std::chrono::milliseconds timeout) {
        std::unique_lock lock(mutex_);
        hasFinished_.wait_for(lock, timeout, [this] { return !finished_.empty(); });
    }

  private:
    void run() {
        std::unique_lock lock(mutex_);
        for (;;) {
            hasWork_.wait(lock, [this] { return isEnding_ || !waiting_.empty(); });
            if (isEnding_) return;
            const world::ChunkPos pos = waiting_.front();
            waiting_.pop_front();
            lock.unlock();
            Tile made{pos, make_(pos)};
            lock.lock();
            finished_.push_back(std::move(made));
            hasFinished_.notify_all();
        }
    }

    std::size_t maxRequested_;
    std::function<T(world::ChunkPos)> make_;
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> requested_;

    std::mutex mutex_;  // guards the members below
    std::condition_variable hasWork_, hasFinished_;
    std::deque<world::ChunkPos> waiting_;
    std::deque<Tile> finished_;
    bool isEnding_ = false;
    std::jthread thread_;  // ends first
};

}  // namespace terrane::view
