// Finds the edits that are visible on a map: an edit below ground changes no tile, and the map must not
// reveal where players dig. It is used on the web's thread; a worker computes surfaces.
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

// Returns the event that reports edits to browsers. Any thread may call it. Its JSON has the event's number,
// and boxes of blocks with inclusive bounds, each with the level of the tiles that show it. With many chunks,
// boxes are enlarged to limit their number.
std::string editEvent(std::uint64_t number, std::span<const world::ChunkPos> chunks);

class VisibleChanges {
  public:
    struct Parts {
        map::MapPainter& painter;
        base::JobSystem& jobs;
        // Runs a function on the web's thread soon. Any thread may call it.
        std::function<void(std::function<void()>)> post;
        // Returns the current state of the edited chunks among these.
        std::function<std::vector<map::EditedChunk>(std::span<const world::ChunkPos>)> editedAmong;
        // Receives the chunks and tiles whose appearance from above changed.
        std::function<void(std::span<const world::ChunkPos>)> onVisible;
    };
    // The painter and the jobs outlive this; later results of jobs are dropped.
    explicit VisibleChanges(Parts parts) : parts_(std::move(parts)) {}
    ~VisibleChanges() { *isAlive_ = false; }

    // Adds edited chunks of level 0, and stored tiles that changed with them. `before` has the positions
    // edited before.
    void add(std::span<const world::ChunkPos> chunks, const map::EditedPositions& before);
    // Examines the added positions. Call a few times per second.
    void examine();

  private:
    struct Change {
        map::EditedChunk chunk;
        bool wasGenerated = false;  // never examined, and generated before the edit
    };
    using Digests = std::unordered_map<world::ChunkPos, std::uint64_t, world::ChunkPosHash>;
    static std::vector<world::ChunkPos> visibleAmong(map::MapPainter& painter,
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
