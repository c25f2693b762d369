// Which edits change what a map shows: an edit under ground changes no tile, and nobody is to learn from a
// map where somebody digs. On the web's thread; surfaces are looked at by a worker.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "terrane/base/job_system.h"
#include "terrane/map/edited_positions.h"
#include "terrane/map/map_painter.h"

namespace terrane::web {

class SeenChanges {
  public:
    struct Parts {
        map::MapPainter& painter;
        base::JobSystem& jobs;
        // Runs a function on the web's thread soon. Any thread.
        std::function<void(std::function<void()>)> post;
        // Those of these chunks that are edited, as they are now.
        std::function<std::vector<map::EditedChunk>(std::span<const world::ChunkPos>)> editedAmong;
        // Called with the chunks and tiles that look different from above.
        std::function<void(std::span<const world::ChunkPos>)> seen;
    };
    // Of the parts the painter and the jobs outlive this; what a job finds after that is dropped.
    explicit SeenChanges(Parts parts) : parts_(std::move(parts)) {}
    ~SeenChanges() { *isAlive_ = false; }

    // Chunks of level 0 that were edited, and tiles of the store that follow from edits. `before`: what was
    // edited before these were.
    void add(std::span<const world::ChunkPos> chunks, const map::EditedPositions& before);
    // Looks at what was added. Some times a second.
    void look();

  private:
    struct Change {
        map::EditedChunk chunk;
        bool wasGenerated = false;  // it was never looked at, and was as generated before
    };
    using Digests = std::unordered_map<world::ChunkPos, std::uint64_t, world::ChunkPosHash>;
    static std::vector<world::ChunkPos> seenAmong(map::MapPainter& painter,
                                                  const std::vector<Change>& changes, Digests& digests);

    Parts parts_;
    std::set<world::ChunkPos> added_;
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> generated_;  // edited since, and never looked at
    std::shared_ptr<Digests> digests_ =
        std::make_shared<Digests>();  // of surfaces; the job's, while one runs
    bool isLooking_ = false;
    std::vector<world::ChunkPos> looking_;  // what the job looks at
    base::JobHandle job_;
    std::shared_ptr<bool> isAlive_ = std::make_shared<bool>(true);  // what is posted may come after the end
};

}  // namespace terrane::web
