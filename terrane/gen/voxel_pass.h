// A 3D pass ready to run: its whole program, and short programs for slabs of layers, which are compiled when
// a slab first needs one. One per 3D pass of a generator; any thread.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>

#include "terrane/gen/short_pass.h"

namespace terrane::gen {

class VoxelPass {
  public:
    // Refers to its arguments.
    VoxelPass(const PassGraph& pass, const std::vector<NoiseCall>& noises);

    const Program& program() const { return program_; }
    const SlabPlan& plan() const { return plan_; }
    std::size_t layerInstructions() const { return layerInstructions_; }  // of the whole program

    // The short pass for these decisions, or null if the whole program must run because the table is full.
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
