// A 3D pass reduced for a slab, without choices that are equal in all voxels and without the values that only
// their other sides need. Used by voxel_pass.cpp.
#pragma once

#include "terrane/gen/slab_ranges.h"

namespace terrane::gen {

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

// The whole pass's graph, program and noises are the plan's.
ShortPass shortenPass(const SlabPlan& plan, const Decisions& decisions);

// Instructions in `list` and in its branches and loops.
std::size_t instructionCount(const Program& program, const InstructionList& list);

}  // namespace terrane::gen
