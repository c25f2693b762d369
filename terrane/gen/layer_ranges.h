// Which layers of a tile are one block throughout, found without computing their columns: interval arithmetic
// over a 3D pass's instructions, with the range of each value that does not depend on z. Most layers of a
// chunk lie above or below all of its ground. Used by executor.cpp; one a thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "terrane/gen/noise.h"
#include "terrane/gen/program.h"
#include "terrane/gen/stamp_tile.h"

namespace terrane::gen {

class LayerRanges {
  public:
    // For a tile whose `column` instructions have run. Refers to its arguments until begun again.
    // `blocks`: of the 3D pass before, by world::BlockIndex, or null. `stamps`: painted, by the program's.
    void begin(const Program& program, const Bits* arena, std::span<const NoiseKind> noises,
               const std::uint16_t* blocks, std::span<const StampTile> stamps = {});

    // The block of all voxels of `count` layers, the lowest at height z, where that is certain.
    std::optional<std::uint16_t> blockOfLayers(std::int32_t z, std::int32_t count);

  private:
    // Values as signed numbers, whatever their type. Wide open where nothing is known.
    struct Range {
        std::int64_t low, high;
    };
    static constexpr Range kAnything = {INT32_MIN, INT32_MAX};

    const Range& read(Operand o);
    void write(Operand o, Range range);
    void run(const InstructionList& list);
    void runBranch(const Branch& branch);
    void forget(const Instruction& i);
    Range resultOf(const Instruction& i);
    Range blocksOfLayers(Range z) const;
    Range stampOfLayers(std::uint32_t stamp) const;

    const Program* program_ = nullptr;
    const Bits* arena_ = nullptr;
    std::span<const NoiseKind> noises_;
    const std::uint16_t* blocks_ = nullptr;
    std::span<const StampTile> stamps_;
    Range z_{};
    std::vector<Range> ranges_;  // by the operand's first row
    std::vector<bool> isKnown_;
};

}  // namespace terrane::gen
