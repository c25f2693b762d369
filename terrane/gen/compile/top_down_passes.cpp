#include "terrane/gen/compile/top_down_passes.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>

#include "terrane/base/result.h"

namespace terrane::gen {
namespace {

// A height: that of z, or of a field of the column, and so many blocks above it.
struct ReadHeight {
    const Node* base;  // Op::PosZ or Op::Field
    int above = 0;
};

bool isHeightBase(const Node& n) {
    return n.op == Op::PosZ || (n.op == Op::Field && n.type == Type::Int);
}

// None beyond the layers of a world, where the sum may overflow.
std::optional<ReadHeight> readHeightOf(const Graph& graph, NodeId height) {
    const Node& n = graph.node(height);
    if (isHeightBase(n)) return ReadHeight{&n};
    if (n.op != Op::AddI && n.op != Op::SubI) return std::nullopt;
    const Node *base = &graph.node(n.args[0]), *constant = &graph.node(n.args[1]);
    if (n.op == Op::AddI && base->op == Op::Constant) std::swap(base, constant);
    if (!isHeightBase(*base) || constant->op != Op::Constant) return std::nullopt;
    const std::int32_t blocks = asInt(constant->imm);
    if (blocks < -world::kMostLayers || blocks > world::kMostLayers) return std::nullopt;
    return ReadHeight{base, n.op == Op::SubI ? -blocks : blocks};
}

}  // namespace

std::optional<int> layersReadBelow(const PassGraph& pass) {
    int below = 0;
    for (NodeId id = 0; id < pass.graph.size(); ++id) {
        const Node& n = pass.graph.node(id);
        if (n.op == Op::BlockAt) return std::nullopt;
        if (n.op != Op::BlockInColumn) continue;
        const std::optional<ReadHeight> height = readHeightOf(pass.graph, n.args[0]);
        if (!height) return std::nullopt;
        if (height->base->op == Op::PosZ) below = std::max(below, -height->above);
    }
    return below;
}

int lowestFieldRead(const PassGraph& pass, const PassInputs& inputs, world::Heights heights) {
    int lowest = heights.top;
    for (NodeId id = 0; id < pass.graph.size(); ++id) {
        const Node& n = pass.graph.node(id);
        if (n.op != Op::BlockInColumn) continue;
        const std::optional<ReadHeight> height = readHeightOf(pass.graph, n.args[0]);
        if (!height || height->base->op != Op::Field) continue;
        for (const Bits value : *inputs.fields[height->base->imm][4])
            lowest = std::min(lowest, heights.clamp(asInt(value + bitsOf(height->above))));
    }
    return lowest;
}

bool canRunTopDown(const GeneratorGraph& generator) {
    return !generator.passes.empty() && generator.passes.back().is3D;
}

int firstTopDownPass(const GeneratorGraph& generator) {
    base::require(canRunTopDown(generator), "firstTopDownPass: the last pass of the generator is not 3D");
    auto pass = generator.passes.size() - 1;
    // A pass before another one must write no field: that takes all of its layers.
    while (pass > 0 && layersReadBelow(generator.passes[pass]) && generator.passes[pass - 1].is3D &&
           generator.passes[pass - 1].fields.empty())
        --pass;
    return std::max(static_cast<int>(pass), sharedPasses(generator));
}

void TopDownPasses::add(const VoxelPass& pass, PassInputs inputs) {
    if (passes_.size() == count_)
        passes_.push_back(std::make_unique<Running>(Executor(noises_, seeds_, parts_), heights_));
    Running& running = *passes_[count_];
    if (count_ > 0) {
        const Running& before = *passes_[count_ - 1];
        inputs.blocks[4] = &before.blocks;
        const std::optional<int> below = layersReadBelow(pass.plan().pass);
        assert(below && "firstTopDownPass() says which passes run together");
        running.readsBelow = *below;
        makeDownTo(lowestFieldRead(pass.plan().pass, inputs, heights_));
    }
    running.executor.begin3D(pass, inputs, running.blocks);
    requested_ = RequestedColumns();
    ++count_;
}

// The lowest layer that can be made from what the pass before has made.
int TopDownPasses::reachOf(std::size_t pass) const {
    if (pass == 0) return heights_.bottom;
    const int made = passes_[pass - 1]->executor.lowestComputed();
    return made == heights_.bottom ? made : std::min(made + passes_[pass]->readsBelow, heights_.top);
}

// The passes before come first, as far as this one reads them: in a few tall slabs instead of many low ones.
void TopDownPasses::makeDownTo(std::size_t pass, int z) {
    Running& running = *passes_[pass];
    if (z >= running.executor.lowestComputed()) return;
    if (pass > 0) makeDownTo(pass - 1, std::max(z - running.readsBelow, heights_.bottom));
    while (z < running.executor.lowestComputed()) running.executor.runTopDown(reachOf(pass), requested_);
}

void TopDownPasses::makeDownTo(int z) {
    makeDownTo(count_ - 1, z);
}

void TopDownPasses::run(const LayerCallback& take) {
    const Running& last = *passes_[count_ - 1];
    const auto isLikeAbove = [&](int z) {
        const BlockRange here = last.blocks.range(z);
        return z + 1 < heights_.top && here.low == here.high && here == last.blocks.range(z + 1);
    };
    for (int z = heights_.top; z-- > heights_.bottom && requested_.rows() != 0;) {
        makeDownTo(z);
        if (isLikeAbove(z)) continue;
        take(z, std::span<const world::BlockId, kTileLanes>(last.blocks.layer(z), kTileLanes), requested_);
    }
}

}  // namespace terrane::gen
