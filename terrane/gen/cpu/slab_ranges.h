// Finds values that are certain in a slab (successive layers of a tile) before its voxels are computed:
// interval arithmetic over the expressions of a 3D pass, starting from the ranges of its column values.
// executor.cpp uses it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "terrane/gen/compile/generator_graph.h"
#include "terrane/gen/compile/program.h"
#include "terrane/gen/compile/value_range.h"
#include "terrane/gen/cpu/block_layers.h"
#include "terrane/gen/noise/stamp_tile.h"

namespace terrane::gen {

enum class Decision : std::uint8_t { Open, True, False };

// Constant data of a pass for the analysis. It is made once per generator; any thread may use it. It refers
// to its arguments.
struct SlabPlan {
    SlabPlan(const PassGraph& pass, const Program& program, const std::vector<NoiseCall>& noises);

    const PassGraph& pass;
    const Program& program;
    const std::vector<NoiseCall>& noises;
    std::vector<std::optional<Operand>>
        columnValues;  // by node: its value in the arena before the layers run
    // Conditions that a slab may decide: those of choices, and their subexpressions.
    std::vector<NodeId> choices;
    std::vector<std::int32_t> choiceOf;  // by node; -1: none
    bool isTooDeep = false;              // expressions nest deeper than the analysis goes
};

// By choice.
using Decisions = std::vector<Decision>;

class SlabRanges {
  public:
    // Begins a tile whose `column` instructions have run. It refers to its arguments until the next call.
    // `blocks`: of the 3D pass before, or null. `stamps`: painted stamps of the pass.
    void begin(const SlabPlan& plan, const Bits* arena, const BlockLayers* blocks,
               std::span<const StampTile> stamps = {});

    // Sets another address of the same values.
    void moveArena(const Bits* arena) { arena_ = arena; }

    // Analyzes `count` layers, the lowest at height z.
    void analyze(std::int32_t z, std::int32_t count);

    // The functions below return results of the last analyzed slab.

    // Returns the choices that are equal in all voxels.
    const Decisions& decisions() const { return decisions_; }
    // Returns the block of all voxels, if it is certain.
    std::optional<std::uint16_t> block() const;
    // Returns whether no voxel writes this field of the pass.
    bool writesNothing(std::size_t fieldOutput) const;
    // Returns whether slabs of fewer layers would decide no more choices.
    bool isSettled() const { return isSettled_; }

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
    ValueRange blocksBetween(const ValueRange& z) const;
    const ValueRange& condition(NodeId id);
    void decide(NodeId id, const ValueRange& range);

    const SlabPlan* plan_ = nullptr;
    const Bits* arena_ = nullptr;
    const BlockLayers* blocks_ = nullptr;
    std::int32_t z_ = 0, count_ = 1;
    std::uint32_t slab_ = 0;
    std::vector<Entry> entries_;  // by node
    Decisions decisions_;
    bool isSettled_ = true;
    ValueRange block_ = kAnyInt;
    std::vector<ValueRange> fields_;
    std::span<const StampTile> stamps_;
};

}  // namespace terrane::gen
