// Finds the edits that are visible on a map: an edit below ground changes no tile, and the map must not
// reveal where somebody digs. On the web's thread; a worker computes surfaces.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "terrane/base/job_system.h"
#include "terrane/map/map_painter.h"
#include "terrane/map/surface_source.h"
#include "terrane/world/coords.h"

namespace terrane::web {

// The event that tells browsers about edits. Plain values; any thread.
// JSON: the event's number, and boxes of blocks with inclusive bounds, each with the level of the tiles that
// show it. With many chunks, boxes are enlarged to limit their number.
std::string editEvent(std::uint64_t number, std::span<const world::ChunkPos> chunks);

class SeenChanges {
  public:
    struct Parts {
        map::MapPainter& painter;
        base::JobSystem& jobs;
        // Runs a function on the web's thread soon. Any thread.
        std::function<void(std::function<void()>)> post;
        // The current state of the edited ones among these chunks.
        std::function<std::vector<map::EditedChunk>(std::span<const world::ChunkPos>)> editedAmong;
        // Called with the chunks and tiles whose appearance from above changed.
        std::function<void(std::span<const world::ChunkPos>)> seen;
    };
    // The painter and the jobs outlive this; later results of jobs are dropped.
    explicit SeenChanges(Parts parts) : parts_(std::move(parts)) {}
    ~SeenChanges() { *isAlive_ = false; }

    // Edited chunks of level 0, and stored tiles that changed with them. `before`: the positions edited
    // before.
    void add(std::span<const world::ChunkPos> chunks, const map::EditedPositions& before);
    // Examines the added positions. Call a few times per second.
    void look();

  private:
    struct Change {
        map::EditedChunk chunk;
        bool wasGenerated = false;  // never examined, and generated before the edit
    };
    using Digests = std::unordered_map<world::ChunkPos, std::uint64_t, world::ChunkPosHash>;
    static std::vector<world::ChunkPos> seenAmong(map::MapPainter& painter,
                                                  const std::vector<Change>& changes, Digests& digests);

    Parts parts_;
    std::set<world::ChunkPos> added_;
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> generated_;  // edited since, and never examined
    std::shared_ptr<Digests> digests_ =
        std::make_shared<Digests>();  // surface digests; owned by the running job
    bool isLooking_ = false;
    std::vector<world::ChunkPos> looking_;  // positions examined by the job
    base::JobHandle job_;
    std::shared_ptr<bool> isAlive_ = std::make_shared<bool>(true);  // for functions posted before destruction
};

}  // namespace terrane::web
