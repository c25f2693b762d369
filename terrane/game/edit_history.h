// The steps in which a player changed a world, so that they can be undone and done again. Plain values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "terrane/world/block_value.h"
#include "terrane/world/world.h"

namespace terrane::game {

struct ChangedBlock {
    world::BlockPos pos;
    world::BlockValue before, after;
};
using EditStep = std::vector<ChangedBlock>;  // each block once

// The step from the values that the recorder noted to those in the world now, without blocks that are the
// same.
EditStep stepSince(const world::World& world, world::BlockRecorder& recorder);
// The same with all that is different now, as for who follows every change; and what of it makes the step.
EditStep allSince(const world::World& world, world::BlockRecorder& recorder);
EditStep stepOf(EditStep changes);

// The blocks that take a step back: those that are still what the step made them. A block that somebody else
// changed since, or whose data changed, stays; one that only grew or was opened does not.
std::vector<world::PlacedBlock> blocksBefore(const world::World& world, const EditStep& step);

enum class HistoryWay : std::uint8_t { Undo, Redo };

// The step that takes back an undone one does it again: both ways hold steps of the same kind.
class EditHistory {
  public:
    static constexpr std::size_t kMaxSteps = 1000;
    // 64 MiB of blocks each way: 800,000. The newest step is kept whatever its size.
    static constexpr std::size_t kMaxBlocks = (64u << 20) / sizeof(ChangedBlock);

    // A new step: what was undone before can no longer be done again. An empty one changes nothing.
    void add(EditStep step);
    // The step to be taken back next; null where there is none. Holds until the history changes.
    const EditStep* next(HistoryWay way) const;
    // That step was taken back, which made `reverse`. An empty one is forgotten.
    void takenBack(HistoryWay way, EditStep reverse);

    std::size_t stepCount(HistoryWay way) const { return of(way).steps.size(); }

  private:
    struct Steps {
        std::deque<EditStep> steps;
        std::size_t blocks = 0;
    };
    Steps& of(HistoryWay way) { return way == HistoryWay::Undo ? undo_ : redo_; }
    const Steps& of(HistoryWay way) const { return way == HistoryWay::Undo ? undo_ : redo_; }
    static void push(Steps& to, EditStep step);

    Steps undo_, redo_;
};

}  // namespace terrane::game
