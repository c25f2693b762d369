// A player's changes of a world as steps that can be undone and redone. All are plain values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "terrane/world/world.h"

namespace terrane::game {

struct ChangedBlock {
    world::BlockPos pos;
    world::BlockValue before, after;
};
using EditStep = std::vector<ChangedBlock>;  // each block once

// Returns the step from the values that the recorder noted to those in the world now, without unchanged
// blocks.
EditStep stepSince(const world::World& world, world::BlockRecorder& recorder);
// Returns the same with blocks of which only the mark of an unsettled liquid differs, for listeners of all
// changes; stepOf() removes these.
EditStep allSince(const world::World& world, world::BlockRecorder& recorder);
EditStep stepOf(EditStep changes);

// Returns the blocks that undo a step: those that still have the value that the step set. A block is left out
// if it was replaced since, or if its data changed; changes of its state alone (growth, opening) do not
// count.
std::vector<world::PlacedBlock> blocksBefore(const world::World& world, const EditStep& step);

enum class HistoryWay : std::uint8_t { Undo, Redo };

// Undoing a step gives the reverse step, which redoes it: both ways hold steps of the same kind.
class EditHistory {
  public:
    static constexpr std::size_t kMaxSteps = 1000;
    // 64 MiB of blocks each way: 800,000. The newest step stays, whatever its size.
    static constexpr std::size_t kMaxBlocks = (64u << 20) / sizeof(ChangedBlock);

    // Adds a step and removes all steps to redo. An empty one changes nothing.
    void add(EditStep step);
    // Returns the next step to undo or redo; null if there is none. Valid until the history changes.
    const EditStep* next(HistoryWay way) const;
    // Removes the next step after it was undone or redone, and adds `reverse`, unless empty, in the other
    // direction.
    void finishStep(HistoryWay way, EditStep reverse);

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
