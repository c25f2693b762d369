// Provides the tiles of a map as PNG files. Recent tiles are cached in memory. Workers paint the others, once
// for concurrent requests; queued tiles without waiting requests are cancelled. It is used on the web's
// thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "terrane/base/job_system.h"
#include "terrane/map/lru_cache.h"
#include "terrane/map/map_painter.h"
#include "terrane/map/surface_source.h"

namespace terrane::web {

struct TileFile {
    std::string png;
    std::string tag;  // hash of the content, for ETag
};
using TileFilePtr = std::shared_ptr<const TileFile>;

struct TileStatistics {
    std::uint64_t painted = 0, fromMemory = 0, cancelled = 0, refused = 0;
    std::size_t waiting = 0;           // tiles queued or being painted
    std::size_t bytes = 0, count = 0;  // in memory
    double paintSeconds = 0;
};

class TileService {
  public:
    struct Parts {
        map::MapPainter& painter;
        base::JobSystem& jobs;
        // Runs a function on the web's thread soon. Any thread may call it.
        std::function<void(std::function<void()>)> post;
        // Returns a loaded chunk of level 0 of a running game; null if it is not loaded. The function may be
        // empty.
        std::function<world::ChunkPtr(world::ChunkPos)> liveChunk = {};
        std::size_t maxBytes = std::size_t{64} << 20;  // limit of files in memory
        std::size_t maxWaiting = 256;                  // limit of queued tiles
    };
    // The painter and the jobs outlive this. The destructor waits for the workers.
    explicit TileService(Parts parts);
    ~TileService();

    using Ticket = std::uint64_t;
    using Ready = std::function<void(base::Result<TileFilePtr>)>;
    // Calls `ready` once: immediately if the tile is in memory, or with Busy if too many are queued,
    // otherwise later. Returns 0 if it was called immediately, otherwise a ticket for cancel().
    Ticket request(const map::MapTile& tile, Ready ready);
    // Cancels a request: its `ready` is not called. Painting is cancelled if no other request waits for the
    // tile and no worker has started.
    void cancel(Ticket ticket);

    // Adds edited chunks of level 0; ignores other levels.
    void addEdited(std::span<const world::ChunkPos> chunks);
    const map::EditedPositions& edited() const { return edited_; }
    // Drops tiles that show these chunks or tiles, so that they are painted again.
    void invalidate(std::span<const world::ChunkPos> chunks);

    // Returns the edited chunks among these, for the painter.
    std::vector<map::EditedChunk> editedAmong(std::span<const world::ChunkPos> chunks) const;
    const TileStatistics& statistics();

  private:
    struct Render;
    using RenderPtr = std::shared_ptr<Render>;
    void start(const map::MapTile& tile, const RenderPtr& render);
    void finish(const map::MapTile& tile, const RenderPtr& render, base::Result<std::string> png,
                double seconds);
    void invalidate(const map::MapTile& tile);

    Parts parts_;
    map::EditedPositions edited_;
    map::LruCache<map::MapTile, TileFilePtr, map::MapTileHash> files_;
    std::unordered_map<map::MapTile, RenderPtr, map::MapTileHash> renders_;  // current renders in progress
    std::unordered_map<Ticket, RenderPtr> tickets_;
    Ticket lastTicket_ = 0;
    TileStatistics statistics_;
    std::shared_ptr<bool> isAlive_ = std::make_shared<bool>(true);  // for functions posted before destruction
};

}  // namespace terrane::web
