#include "terrane/gen/cpu/slab_ranges.h"

#include <algorithm>
#include <array>

namespace terrane::gen {
namespace {

// Expressions are walked by recursion, some 300 bytes of stack each.
constexpr int kMaxDepth = 2000;

bool dependsOnZ(const Node& n) {
    return (n.dependence & kDependsZ) != 0;
}

// Nodes that the layers need: those that depend on z, and their arguments that do not.
std::vector<bool> neededByLayers(const PassGraph& pass) {
    std::vector<bool> needed(pass.graph.size());
    std::vector<NodeId> stack = outputsOf(pass);
    while (!stack.empty()) {
        const NodeId id = stack.back();
        stack.pop_back();
        if (needed[id]) continue;
        needed[id] = true;
        const Node& n = pass.graph.node(id);
        // The analysis does not look into loops.
        if (!dependsOnZ(n) || n.op == Op::LoopOut) continue;
        stack.insert(stack.end(), n.arguments().begin(), n.arguments().end());
    }
    return needed;
}

bool isTooDeepFor(const PassGraph& pass, const std::vector<bool>& needed) {
    std::vector<int> depth(pass.graph.size());
    for (NodeId id = 0; id < pass.graph.size(); ++id) {
        if (!needed[id]) continue;
        for (const NodeId arg : pass.graph.node(id).arguments()) {
            if (needed[arg]) depth[id] = std::max(depth[id], depth[arg] + 1);
        }
        if (depth[id] > kMaxDepth) return true;
    }
    return false;
}

// Range of the blocks in these layers. `mayNarrow`: whether fewer layers may be asked for.
ValueRange rangeOfBlocks(const BlockLayers& blocks, int first, int last, bool mayNarrow) {
    const std::optional<BlockLayers::LayersRange> found = blocks.range(first, last);
    ValueRange range = found ? intRange(found->blocks.low, found->blocks.high) : intRange(0, UINT16_MAX);
    range.mayNarrow = found ? !found->isAlike : mayNarrow;
    return range;
}

}  // namespace

SlabPlan::SlabPlan(const PassGraph& passGraph, const Program& passProgram,
                   const std::vector<NoiseCall>& calls)
    : pass(passGraph),
      program(passProgram),
      noises(calls),
      columnValues(passGraph.graph.size()),
      choiceOf(passGraph.graph.size(), -1) {
    const Graph& graph = pass.graph;
    for (const Program::Input& input : program.inputs) columnValues[input.node] = input.value;
    const std::vector<bool> needed = neededByLayers(pass);
    isTooDeep = isTooDeepFor(pass, needed);
    for (NodeId id = 0; id < graph.size(); ++id) {
        const Node& n = graph.node(id);
        if (!needed[id] || n.type != Type::Bool || n.op == Op::Constant || n.loop != kNoLoop) continue;
        choiceOf[id] = static_cast<std::int32_t>(choices.size());
        choices.push_back(id);
    }
}

void SlabRanges::begin(const SlabPlan& plan, const Bits* arena, const BlockLayers* blocks,
                       std::span<const StampTile> stamps) {
    stamps_ = stamps;
    plan_ = &plan;
    arena_ = arena;
    blocks_ = blocks;
    slab_ = 0;
    entries_.assign(plan.pass.graph.size(), Entry());
    decisions_.assign(plan.choices.size(), Decision::Open);
}

void SlabRanges::analyze(std::int32_t z, std::int32_t count) {
    z_ = z;
    count_ = count;
    ++slab_;
    isSettled_ = true;
    std::fill(decisions_.begin(), decisions_.end(), Decision::Open);
    const PassGraph& pass = plan_->pass;
    fields_.assign(pass.fields.size(), kAnyBool);
    block_ = kAnyInt;
    if (plan_->isTooDeep) return;
    block_ = find(*pass.block);
    for (std::size_t k = 0; k < fields_.size(); ++k) {
        if (pass.fields[k].isWritten) fields_[k] = condition(*pass.fields[k].isWritten);
    }
}

std::optional<std::uint16_t> SlabRanges::block() const {
    if (!isCertain(block_)) return std::nullopt;
    return static_cast<std::uint16_t>(block_.low);
}

bool SlabRanges::writesNothing(std::size_t fieldOutput) const {
    const ValueRange& isWritten = fields_[fieldOutput];
    return isCertain(isWritten) && isWritten.low == 0;
}

const ValueRange& SlabRanges::find(NodeId id) {
    Entry& entry = entries_[id];
    if (entry.slab != slab_ && !entry.isOfTile) {
        const Node& n = plan_->pass.graph.node(id);
        entry.isOfTile = !dependsOnZ(n);
        entry.slab = slab_;
        entry.range = entry.isOfTile ? columnRange(id) : compute(id);
    }
    return entry.range;
}

ValueRange SlabRanges::columnRange(NodeId id) {
    const Node& n = plan_->pass.graph.node(id);
    if (n.op == Op::Constant) return rangeOf(n.type, n.imm);
    const std::optional<Operand>& value = plan_->columnValues[id];
    if (!value) return unknownRange(n.type);
    const Bits* lanes = arena_ + std::size_t{value->row} * kRowLanes;
    return value->rowStep == 0 ? rangeOf(n.type, *lanes) : rangeOfTile(n.type, lanes);
}

ValueRange SlabRanges::compute(NodeId id) {
    const Node& n = plan_->pass.graph.node(id);
    switch (n.op) {
        case Op::PosZ: {
            ValueRange z = intRange(z_, z_ + count_ - 1);
            z.mayNarrow = count_ > 1;
            return z;
        }
        case Op::BlockHere: {
            ValueRange z = intRange(z_, z_ + count_ - 1);
            z.mayNarrow = count_ > 1;
            return blocksBetween(z);
        }
        case Op::BlockInColumn:
            return blocksBetween(find(n.args[0]));
        case Op::BlockAt:
            return intRange(0, UINT16_MAX);
        case Op::Stamp:
            return rangeOfBlocks(stamps_[n.imm].blocks(), z_, z_ + count_ - 1, count_ > 1);
        case Op::Component:
            return component(n);
        case Op::And:
        case Op::Or:
            return logic(n);
        case Op::Select:
        case Op::Phi:
            return choice(n);
        default:
            break;
    }
    if (!record(n.op).evaluate) return unknownRange(n.type);
    std::array<ValueRange, 3> args{kAnyInt, kAnyInt, kAnyInt};
    const std::size_t count = n.arguments().size();
    for (std::size_t k = 0; k < count; ++k) args[k] = find(n.args[k]);
    return resultRange(n.op, n.type, std::span(args).first(count));
}

// Range of a condition of a choice or of a written field. Notes it as a decision if it is certain.
const ValueRange& SlabRanges::condition(NodeId id) {
    const ValueRange& range = find(id);
    decide(id, range);
    if (!isCertain(range) && range.mayNarrow) isSettled_ = false;
    return range;
}

void SlabRanges::decide(NodeId id, const ValueRange& range) {
    const std::int32_t number = plan_->choiceOf[id];
    if (number < 0 || !isCertain(range)) return;
    decisions_[static_cast<std::size_t>(number)] = range.low != 0 ? Decision::True : Decision::False;
}

// Skips a side that no voxel takes.
ValueRange SlabRanges::choice(const Node& n) {
    const ValueRange& when = condition(n.args[0]);
    if (isCertain(when)) return find(when.low != 0 ? n.args[1] : n.args[2]);
    const ValueRange args[] = {when, find(n.args[1]), find(n.args[2])};
    return resultRange(n.op, n.type, args);
}

// Evaluates the second argument only if the first leaves the result open. If the result stays open, notes an
// argument that is certain as a decision, so that it is not computed.
ValueRange SlabRanges::logic(const Node& n) {
    const ValueRange first = find(n.args[0]);
    const std::int32_t decisive = n.op == Op::And ? 0 : -1;
    if (isCertain(first) && first.low == decisive) return first;
    const ValueRange args[] = {first, find(n.args[1])};
    const ValueRange result = resultRange(n.op, n.type, args);
    if (isCertain(result)) return result;
    decide(n.args[0], args[0]);
    decide(n.args[1], args[1]);
    return result;
}

ValueRange SlabRanges::component(const Node& n) const {
    const Node& noise = plan_->pass.graph.node(n.args[0]);
    const NoiseCall& call = plan_->noises[noise.imm];
    if (call.kind == NoiseKind::Perlin3D) return perlin3DRange(call);
    return unknownRange(n.type);
}

// Range of the blocks of the pass before in layers z. Heights beyond the world are clamped into it. A height
// that differs from column to column may be anywhere.
ValueRange SlabRanges::blocksBetween(const ValueRange& z) const {
    if (!blocks_) return intRange(0, UINT16_MAX);
    const world::Heights heights = blocks_->heights();
    return rangeOfBlocks(*blocks_, heights.clamp(z.low), heights.clamp(z.high), z.mayNarrow);
}

}  // namespace terrane::gen
