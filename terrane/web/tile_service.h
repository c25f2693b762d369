// The tiles of a map as PNG files: kept in memory while they are used, painted by workers when somebody asks,
// once for all who ask at a time, and not at all when nobody waits any more. On one thread, the web's;
// painting runs on workers.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "terrane/base/job_system.h"
#include "terrane/map/edited_positions.h"
#include "terrane/map/lru_cache.h"
#include "terrane/map/map_painter.h"

namespace terrane::web {

struct TileFile {
    std::string png;
    std::string tag;  // names the content, for ETag
};
using TileFilePtr = std::shared_ptr<const TileFile>;

struct TileStatistics {
    std::uint64_t painted = 0, fromMemory = 0, cancelled = 0, refused = 0;
    std::size_t waiting = 0;           // tiles that are painted or to be painted
    std::size_t bytes = 0, count = 0;  // in memory
    double paintSeconds = 0;
};

class TileService {
  public:
    struct Parts {
        map::MapPainter& painter;
        base::JobSystem& jobs;
        // Runs a function on the web's thread soon. Any thread.
        std::function<void(std::function<void()>)> post;
        // A chunk of level 0 as it is in a running game; null where it is not loaded. May be empty.
        std::function<world::ChunkPtr(world::ChunkPos)> liveChunk = {};
        std::size_t maxBytes = std::size_t{64} << 20;  // of files in memory
        std::size_t maxWaiting = 256;                  // tiles
    };
    // All but the functions outlives it; it waits for its workers at the end.
    explicit TileService(Parts parts);
    ~TileService();

    using Ticket = std::uint64_t;
    using Ready = std::function<void(base::Result<TileFilePtr>)>;
    // Calls `ready` once: at once where memory has the tile, or with Busy where too many wait, else later. 0
    // where it was called; else what cancel() takes.
    Ticket request(const map::MapTile& tile, Ready ready);
    // `ready` is not called any more. A tile that nobody else waits for is not painted unless a worker is at
    // it.
    void cancel(Ticket ticket);

    // Chunks of level 0 that are edited from now on; others are left out.
    void addEdited(std::span<const world::ChunkPos> chunks);
    const map::EditedPositions& edited() const { return edited_; }
    // What shows these chunks and tiles is painted anew.
    void forget(std::span<const world::ChunkPos> chunks);

    // The edited chunks among these, to be given to the painter.
    std::vector<map::EditedChunk> editedAmong(std::span<const world::ChunkPos> chunks) const;
    const TileStatistics& statistics();

  private:
    struct Render;
    using RenderPtr = std::shared_ptr<Render>;
    void start(const map::MapTile& tile, const RenderPtr& render);
    void finish(const map::MapTile& tile, const RenderPtr& render, base::Result<std::string> png,
                double seconds);
    void forget(const map::MapTile& tile);

    Parts parts_;
    map::EditedPositions edited_;
    map::LruCache<map::MapTile, TileFilePtr, map::MapTileHash> files_;
    std::unordered_map<map::MapTile, RenderPtr, map::MapTileHash> renders_;  // of what is shown now
    std::unordered_map<Ticket, RenderPtr> tickets_;
    Ticket lastTicket_ = 0;
    TileStatistics statistics_;
    std::shared_ptr<bool> isAlive_ = std::make_shared<bool>(true);  // what is posted may come after the end
};

}  // namespace terrane::web
