// The value of a node at a place by plain recursion: a choice looks at its condition and takes one side.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <vector>

#include "terrane/shared/generation.h"
#include "tests/gen/noise_reference.h"
#include "tests/gen/pass_runner.h"

namespace terrane::gen {

class SlowEvaluator {
  public:
    SlowEvaluator(const PassRunner& runner, const Graph& graph)
        : runner_(runner), graph_(graph), values_(graph.size()), known_(graph.size()) {}

    // Values of nodes are for this place from here on. It lies in the runner's chunk.
    void moveTo(world::BlockPos at) {
        at_ = at;
        known_.assign(known_.size(), false);
    }

    Bits value(NodeId id) {
        if (!known_[id]) values_[id] = compute(graph_.node(id));
        known_[id] = true;
        return values_[id];
    }

  private:
    Bits compute(const Node& n) {
        if (n.op == Op::Phi) return value(asBool(value(n.args[0])) ? n.args[1] : n.args[2]);
        if (n.op == Op::LoopOut) return loopOut(n.imm);
        if (n.op == Op::Component) return component(graph_.node(n.args[0]), n.imm);
        std::vector<Bits> args;
        for (const NodeId arg : n.arguments()) args.push_back(value(arg));
        const auto evaluate = record(n.op).evaluate;
        return evaluate ? evaluate(args) : atPlace(n, args);
    }

    Bits component(const Node& source, std::uint32_t number) {
        if (source.op == Op::Noise) return noise(source.imm, number);
        const std::array<float, 2> direction = {asFloat(value(source.args[0])),
                                                asFloat(value(source.args[1]))};
        const auto stripes = reference::stripes2D(
            runner_.graph.noises[source.imm], PassRunner::noiseSeed(source.imm), {at_.x, at_.y}, direction);
        return bitsOf(stripes[number]);
    }

    Bits atPlace(const Node& n, const std::vector<Bits>& args) const {
        switch (n.op) {
            case Op::Constant:
                return n.imm;
            case Op::PosX:
                return bitsOf(at_.x);
            case Op::PosY:
                return bitsOf(at_.y);
            case Op::PosZ:
                return bitsOf(at_.z);
            case Op::Field:
                return runner_.fields[n.imm][lane()];
            case Op::FieldAt:
                return fieldAt(n.imm, asInt(args[0]), asInt(args[1]));
            case Op::BlockHere:
                return block(at_.z);
            case Op::BlockInColumn:
                return block(asInt(args[0]));
            case Op::BlockAt:
                return blockAt(asInt(args[0]), asInt(args[1]), asInt(args[2]));
            case Op::Hash2:
                return shared::hash2(args[0], args[1], hashSeed(n.imm));
            case Op::Hash3:
                return shared::hash3(args[0], args[1], args[2], hashSeed(n.imm));
            default:
                break;
        }
        assert(false && "a noise is read through its components");
        return 0;
    }

    std::size_t lane() const { return static_cast<std::size_t>((at_.x & 15) + 16 * (at_.y & 15)); }

    static std::uint32_t hashSeed(std::uint32_t packed) {
        return reference::octaveSeed(PassRunner::hashSeed(packed & 0xFFFFFF), packed >> 24);
    }

    Bits block(std::int32_t z) const { return blockAt(0, 0, z); }

    Bits blockAt(std::int32_t dx, std::int32_t dy, std::int32_t z) const {
        const int x = (at_.x & 15) + 16 + std::clamp(dx, -16, 16);  // from the corner of the nine chunks
        const int y = (at_.y & 15) + 16 + std::clamp(dy, -16, 16);
        const auto chunk = static_cast<std::size_t>(y / 16 * 3 + x / 16);
        const BlockArray& blocks = chunk == 4 ? *runner_.blocks : *runner_.blocksAround[chunk];
        return blocks.layer(blocks.heights.clamp(z))[x % 16 + y % 16 * 16];
    }

    // Round by round; what depends on the loop's variables is forgotten before each.
    Bits loopOut(std::uint32_t variable) {
        const std::int32_t number = graph_.loopVariable(variable).loop;
        const Loop& loop = graph_.loops()[static_cast<std::size_t>(number)];
        std::vector<Bits> now;
        for (const std::uint32_t v : loop.variables) now.push_back(value(graph_.loopVariable(v).initial));
        for (int round = 0;; ++round) {
            beginRound(number, now);
            if (round == shared::kMaxLoopRounds || !asBool(value(loop.condition))) break;
            std::vector<Bits> next;
            for (const std::uint32_t v : loop.variables) next.push_back(value(graph_.loopVariable(v).next));
            now = next;
        }
        const auto place = std::find(loop.variables.begin(), loop.variables.end(), variable);
        return now[static_cast<std::size_t>(place - loop.variables.begin())];
    }

    void beginRound(std::int32_t number, const std::vector<Bits>& now) {
        for (NodeId id = 0; id < graph_.size(); ++id) {
            if (isInLoop(graph_.node(id).loop, number)) known_[id] = false;
        }
        const Loop& loop = graph_.loops()[static_cast<std::size_t>(number)];
        for (std::size_t k = 0; k < now.size(); ++k) {
            const NodeId in = graph_.loopVariable(loop.variables[k]).in;
            values_[in] = now[k];
            known_[in] = true;
        }
    }

    bool isInLoop(std::int32_t loop, std::int32_t outer) const {
        while (loop != outer && loop != kNoLoop) loop = graph_.loops()[static_cast<std::size_t>(loop)].parent;
        return loop == outer;
    }

    Bits fieldAt(std::uint32_t field, std::int32_t dx, std::int32_t dy) const {
        const int x = (at_.x & 15) + 16 + std::clamp(dx, -16, 16);  // from the corner of the nine chunks
        const int y = (at_.y & 15) + 16 + std::clamp(dy, -16, 16);
        const auto chunk = static_cast<std::size_t>(y / 16 * 3 + x / 16);
        return runner_.around[field][chunk][static_cast<std::size_t>(x % 16 + y % 16 * 16)];
    }

    Bits noise(std::uint32_t number, std::uint32_t component) const {
        const NoiseCall& call = runner_.graph.noises[number];
        const std::uint32_t seed = PassRunner::noiseSeed(number);
        if (call.kind == NoiseKind::Perlin2D) return bitsOf(reference::perlin2D(call, seed, at_.x, at_.y));
        if (call.kind == NoiseKind::Simplex2D) return bitsOf(reference::simplex2D(call, seed, at_.x, at_.y));
        if (call.kind == NoiseKind::Perlin3D) {
            return bitsOf(reference::perlin3D(call, seed, {at_.x, at_.y, at_.z}));
        }
        if (call.kind == NoiseKind::Voronoi3D) {
            const auto sample = reference::voronoi3D(call, seed, {at_.x, at_.y, at_.z});
            const std::array<Bits, 5> solid = {bitsOf(sample.nearest), bitsOf(sample.second),
                                               bitsOf(sample.offset[0]), bitsOf(sample.offset[1]),
                                               bitsOf(sample.offset[2])};
            return solid[component];
        }
        const reference::VoronoiSample sample = reference::voronoi2D(call, seed, at_.x, at_.y, 2);
        const std::array<Bits, 4> results = {bitsOf(sample.distance), bitsOf(sample.ratio),
                                             bitsOf(sample.offsetX), bitsOf(sample.offsetY)};
        return results[component];
    }

    const PassRunner& runner_;
    const Graph& graph_;
    world::BlockPos at_;
    std::vector<Bits> values_;  // by node
    std::vector<bool> known_;
};

}  // namespace terrane::gen
