#include "terrane/gen/layer_ranges.h"

#include <algorithm>
#include <cstring>

#include "terrane/world/coords.h"

namespace terrane::gen {

void LayerRanges::begin(const Program& program, const Bits* arena, std::span<const NoiseKind> noises,
                        const std::uint16_t* blocks, std::span<const StampTile> stamps) {
    blocks_ = blocks;
    stamps_ = stamps;
    program_ = &program;
    arena_ = arena;
    noises_ = noises;
    ranges_.resize(program.arenaRows);
    isKnown_.assign(program.arenaRows, false);
}

std::optional<std::uint16_t> LayerRanges::blockOfLayers(std::int32_t z, std::int32_t count) {
    z_ = {z, z + count - 1};
    write(program_->z, z_);
    run(program_->layer);
    const Range block = read(*program_->block);
    if (block.low != block.high) return std::nullopt;
    return static_cast<std::uint16_t>(block.low);
}

// What no instruction of the layer wrote lies in the arena, the same for all layers.
const LayerRanges::Range& LayerRanges::read(Operand o) {
    if (!isKnown_[o.row]) {
        const Bits* first = arena_ + std::size_t{o.row} * kRowLanes;
        Range range = {asInt(*first), asInt(*first)};
        const int count = o.rowStep == 0 ? 1 : kTileLanes;
        for (int k = 1; k < count; ++k) {
            range.low = std::min<std::int64_t>(range.low, asInt(first[k]));
            range.high = std::max<std::int64_t>(range.high, asInt(first[k]));
        }
        write(o, range);
    }
    return ranges_[o.row];
}

void LayerRanges::write(Operand o, Range range) {
    ranges_[o.row] = range;
    isKnown_[o.row] = true;
}

void LayerRanges::run(const InstructionList& list) {
    for (const Instruction& i : list) {
        if (i.op == Op::Phi) {
            runBranch(program_->branches[i.imm]);
        } else if (i.op == Op::LoopOut || makesNoise(i.op)) {
            forget(i);
        } else {
            write(i.dst, resultOf(i));
        }
    }
}

// A side that some columns take and others do not is not looked at: only the phis are used after it.
void LayerRanges::runBranch(const Branch& branch) {
    const Range condition = read(branch.condition);
    if (condition.low != condition.high) {
        for (const PhiMove& move : branch.phis) write(move.dst, kAnything);
        return;
    }
    const bool isTaken = condition.low != 0;
    run(isTaken ? branch.then : branch.otherwise);
    for (const PhiMove& move : branch.phis) write(move.dst, read(isTaken ? move.then : move.otherwise));
}

// Loops and noise have several results.
void LayerRanges::forget(const Instruction& i) {
    if (makesNoise(i.op)) {
        for (std::uint32_t k = 0; k < resultCount(noises_[i.imm]); ++k) {
            write({static_cast<std::uint16_t>(i.dst.row + k * kTileSize), i.dst.rowStep}, kAnything);
        }
        return;
    }
    for (const LoopMove& variable : program_->loops[i.imm].variables) write(variable.in, kAnything);
}

// Of the pass before.
LayerRanges::Range LayerRanges::blocksOfLayers(Range z) const {
    const auto within = [](std::int64_t at) {
        return static_cast<std::size_t>(std::clamp<std::int64_t>(at, 0, world::kChunkHeight - 1));
    };
    const std::size_t count = (within(z.high) - within(z.low) + 1) * kTileLanes;
    const std::uint16_t* first = blocks_ + within(z.low) * kTileLanes;
    const bool isUniform = std::memcmp(first, first + 1, (count - 1) * sizeof(*first)) == 0;
    return isUniform ? Range{*first, *first} : Range{0, UINT16_MAX};
}

LayerRanges::Range LayerRanges::stampOfLayers(std::uint32_t stamp) const {
    const bool isPainted = stamps_[stamp].isPainted(static_cast<int>(z_.low), static_cast<int>(z_.high));
    return {0, isPainted ? UINT16_MAX : 0};
}

LayerRanges::Range LayerRanges::resultOf(const Instruction& i) {
    const auto arg = [&](std::size_t k) { return read(i.args[k]); };
    const auto condition = [&](std::size_t k) {
        return Range{std::max<std::int64_t>(arg(k).low, -1), std::min<std::int64_t>(arg(k).high, 0)};
    };
    // Lanes of a condition are all zeros or all ones: 0 or −1.
    const auto truth = [](bool always, bool never) { return Range{never ? 0 : -1, always ? -1 : 0}; };
    const auto unlessWrapped = [](Range r) {
        return r.low < kAnything.low || r.high > kAnything.high ? kAnything : r;
    };
    switch (i.op) {
        case Op::LessI:
            return truth(arg(0).high < arg(1).low, arg(0).low >= arg(1).high);
        case Op::LessEqualI:
            return truth(arg(0).high <= arg(1).low, arg(0).low > arg(1).high);
        case Op::EqualI: {
            const Range a = arg(0), b = arg(1);
            return truth(a.low == a.high && b.low == b.high && a.low == b.low,
                         a.high < b.low || b.high < a.low);
        }
        case Op::And:  // of 0 and −1 the larger is 0
            return {std::max(condition(0).low, condition(1).low),
                    std::max(condition(0).high, condition(1).high)};
        case Op::Or:
            return {std::min(condition(0).low, condition(1).low),
                    std::min(condition(0).high, condition(1).high)};
        case Op::Not:
            return {-1 - condition(0).high, -1 - condition(0).low};
        case Op::AddI:
            return unlessWrapped({arg(0).low + arg(1).low, arg(0).high + arg(1).high});
        case Op::SubI:
            return unlessWrapped({arg(0).low - arg(1).high, arg(0).high - arg(1).low});
        case Op::MinI:
            return {std::min(arg(0).low, arg(1).low), std::min(arg(0).high, arg(1).high)};
        case Op::MaxI:
            return {std::max(arg(0).low, arg(1).low), std::max(arg(0).high, arg(1).high)};
        case Op::Select: {
            const Range choice = arg(0), yes = arg(1), no = arg(2);
            if (choice.low == choice.high) return choice.low != 0 ? yes : no;
            return {std::min(yes.low, no.low), std::max(yes.high, no.high)};
        }
        case Op::Stamp:
            return stampOfLayers(i.imm);
        case Op::BlockHere:
            return blocksOfLayers(z_);
        case Op::BlockInColumn:
            return blocksOfLayers(arg(0));
        default:
            return kAnything;
    }
}

}  // namespace terrane::gen
