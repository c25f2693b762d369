// A 3D pass ready to run: its whole program, and short programs for slabs of layers, which are compiled when
// a slab first needs one. One per 3D pass of a generator; any thread may use it.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>

#include "terrane/gen/cpu/slab_ranges.h"

namespace terrane::gen {

// A 3D pass reduced for a slab, without choices that are equal in all voxels and without the values that only
// their other sides need. voxel_pass.cpp uses it.
struct ShortPass {
    enum class Kind : std::uint8_t {
        CopyBlocks,  // leaves the blocks of the 3D pass before as they are
        OneLayer,    // all layers are equal
        EachLayer
    };
    Kind kind = Kind::EachLayer;
    Program program;                     // to run after the pass's whole program has run its `column`
    std::vector<RowConstant> constants;  // to fill before
    std::size_t layerInstructions = 0;
};

// Returns the short pass for the decisions. The whole pass's graph, program and noises are those of the plan.
ShortPass shortenPass(const SlabPlan& plan, const Decisions& decisions);

// Instructions in `list` and in its branches and loops.
std::size_t instructionCount(const Program& program, const InstructionList& list);

class VoxelPass {
  public:
    // Refers to its arguments.
    VoxelPass(const PassGraph& pass, const std::vector<NoiseCall>& noises);

    const Program& program() const { return program_; }
    const SlabPlan& plan() const { return plan_; }
    std::size_t layerInstructions() const { return layerInstructions_; }  // of the whole program

    // Returns the short pass for these decisions, or null if the whole program must run because the table is
    // full.
    const ShortPass* find(const Decisions& decisions) const;

  private:
    struct Entry {
        Decisions decisions;
        ShortPass pass;
    };
    // The overworld's passes have some dozens. 256 programs of at most kMaxInstructions / 256 instructions of
    // 24 bytes on average: 3 MB a pass.
    static constexpr std::size_t kMaxEntries = 256, kSlots = 4 * kMaxEntries, kMaxInstructions = 1 << 17;
    static_assert((kSlots & (kSlots - 1)) == 0);

    const ShortPass* add(const Decisions& decisions, std::size_t slot) const;

    Program program_;
    SlabPlan plan_;
    std::size_t layerInstructions_;
    // A hash table with open addressing whose entries stay. Readers take no lock.
    mutable std::array<std::atomic<const Entry*>, kSlots> slots_{};
    mutable std::mutex mutex_;
    mutable std::vector<std::unique_ptr<const Entry>> entries_;  // guarded by mutex_
    mutable std::size_t instructions_ = 0;                       // of all entries, guarded by mutex_
    mutable std::atomic<bool> isFull_ = false;
};

}  // namespace terrane::gen
