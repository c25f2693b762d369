// What is certain in a slab, some successive layers of a tile, before any voxel of it is computed: interval
// arithmetic over the expressions of a 3D pass, from the ranges of what its columns have computed already.
// Used by executor.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "terrane/gen/generator_graph.h"
#include "terrane/gen/program.h"
#include "terrane/gen/range_kernels.h"
#include "terrane/gen/stamp_tile.h"
#include "terrane/gen/value_range.h"
#include "terrane/world/coords.h"

namespace terrane::gen {

enum class Decision : std::uint8_t { Open, True, False };

// What never changes for a pass. Made once a generator; any thread. Refers to its arguments.
struct SlabPlan {
    SlabPlan(const PassGraph& pass, const Program& program, const std::vector<NoiseCall>& noises);

    const PassGraph& pass;
    const Program& program;
    const std::vector<NoiseCall>& noises;
    std::vector<std::optional<Operand>>
        columnValues;  // by node: what lies in the arena before the layers run
    // Conditions that a slab may decide: those of choices, and what they are made of.
    std::vector<NodeId> choices;
    std::vector<std::int32_t> choiceOf;  // by node; -1: none
    bool isTooDeep = false;              // expressions nest deeper than the analysis goes
};

// By choice.
using Decisions = std::vector<Decision>;

class SlabRanges {
  public:
    // For a tile whose `column` instructions have run. Refers to its arguments until begun again.
    // `blocks`: of the 3D pass before, by world::BlockIndex, or null.
    // `layers`: of them, or null where they are to be found.
    // `stamps`: of the pass, painted.
    void begin(const SlabPlan& plan, const Bits* arena, const std::uint16_t* blocks,
               std::span<const StampTile> stamps = {}, const LayerRanges* layers = nullptr);

    // The same values, moved to another place.
    void moveArena(const Bits* arena) { arena_ = arena; }

    // Looks at `count` layers, the lowest at height z.
    void analyze(std::int32_t z, std::int32_t count);

    // Of the slab looked at last: the choices that all its voxels make alike,
    const Decisions& decisions() const { return decisions_; }
    // the block of all of its voxels, where that is certain,
    std::optional<std::uint16_t> block() const;
    // whether its voxels leave a field that the pass writes as it is,
    bool writesNothing(std::size_t fieldOutput) const;
    // and whether slabs of fewer layers would decide no more choices than it.
    bool isSettled() const { return isSettled_; }

    // Of the blocks of the 3D pass before in the layer z.
    BlockRange layerBefore(int z);

  private:
    struct Entry {
        ValueRange range = kAnyInt;
        std::uint32_t slab = 0;  // for which it was found; 0: none
        bool isOfTile = false;   // the same for all slabs
    };

    const ValueRange& find(NodeId id);
    ValueRange compute(NodeId id);
    ValueRange columnRange(NodeId id);
    ValueRange choice(const Node& n);
    ValueRange logic(const Node& n);
    ValueRange component(const Node& n) const;
    ValueRange blocksBetween(const ValueRange& z);
    ValueRange stampBlocks(const StampTile& stamp) const;
    const ValueRange& condition(NodeId id);
    void decide(NodeId id, const ValueRange& range);

    const SlabPlan* plan_ = nullptr;
    const Bits* arena_ = nullptr;
    const std::uint16_t* blocks_ = nullptr;
    std::int32_t z_ = 0, count_ = 1;
    std::uint32_t slab_ = 0;
    std::vector<Entry> entries_;  // by node
    Decisions decisions_;
    bool isSettled_ = true;
    ValueRange block_ = kAnyInt;
    std::vector<ValueRange> fields_;
    const LayerRanges* given_ = nullptr;
    std::span<const StampTile> stamps_;
    LayerRanges layers_{};  // of the pass before
    std::array<bool, world::kChunkHeight> isLayerKnown_{};
};

}  // namespace terrane::gen
