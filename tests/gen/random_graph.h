// Passes made of random operations: ifs nested in ifs, values shared between branches, every kind of read.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "terrane/gen/language/builder.h"
#include "tests/gen/pass_runner.h"

namespace terrane::gen {

inline Bits randomBits(Type type, std::mt19937& random) {
    constexpr float kInf = std::numeric_limits<float>::infinity();
    constexpr std::array<float, 10> kFloats = {
        0.0f,   -0.0f,   1.0f, -1.0f,  0.5f,
        3.0e9f, -3.0e9f, kInf, 1e-40f, std::numeric_limits<float>::quiet_NaN()};
    constexpr std::array<std::int32_t, 8> kInts = {
        0, 1, -1, 16, 2147483647, std::numeric_limits<std::int32_t>::min(), 31, -17};
    const std::uint32_t r = random(), choice = random() % 4;
    if (type == Type::Bool) return bitsOf(r % 2 == 0);
    if (type == Type::Int) {
        if (choice == 0) return bitsOf(kInts[r % kInts.size()]);
        return choice == 1 ? r : bitsOf(static_cast<std::int32_t>(r % 400) - 200);
    }
    if (choice == 0) return bitsOf(kFloats[r % kFloats.size()]);
    if (choice == 1) return r;
    return bitsOf((static_cast<float>(r % 4096) - 2048.0f) / 64.0f);
}

inline ColumnValues randomColumns(Type type, std::mt19937& random) {
    ColumnValues values;
    for (Bits& v : values) v = randomBits(type, random);
    return values;
}

class RandomGraph {
  public:
    RandomGraph(std::uint32_t seed, bool is3D, bool hasLoops = true) : random_(seed), hasLoops_(hasLoops) {
        pass_.name = "random";
        pass_.is3D = is3D;
        addLeaves();
        for (int step = 0; step < 40; ++step) grow(0);
    }

    const Graph& graph() const { return pass_.graph; }

    // Some nodes that everything may hang from.
    std::vector<NodeId> someNodes() {
        return {pick(Type::Float), pick(Type::Int), pick(Type::Bool), pick(Type::Int)};
    }

    // The generator with this one pass. It reads fields 0 to 3, and writes the others or the block.
    GeneratorGraph take(world::Heights heights = {}) {
        GeneratorGraph g;
        g.heights = heights;
        for (const Type type : kFields) g.fields.push_back({"read", type, 0});
        for (const Type type : kFields) g.fields.push_back({"written", type, 1});
        g.noises = {{NoiseKind::Perlin2D, "a", 5, {1.0f, 0.0f, -0.5f}, 1},
                    {NoiseKind::Perlin3D, "b", 3, {0.75f, 0.25f}, 1},
                    {NoiseKind::Voronoi2D, "c", 7, {}, 3},
                    {NoiseKind::Voronoi3D, "d", 9, {}, 2, 3},
                    {NoiseKind::Simplex2D, "e", 6, {0.5f, 1.0f}},
                    {NoiseKind::Stripes2D, "f", 11, {}}};
        g.hashNames = {"p", "q"};
        if (pass_.is3D) {
            pass_.block = mixed();
        } else {
            for (std::uint32_t k = 0; k < kFields.size(); ++k) {
                pass_.fields.push_back({k + 4, pick(kFields[k])});
            }
        }
        g.passes.push_back(std::move(pass_));
        return g;
    }

    // Fills what the pass reads.
    static void fillInputs(PassRunner& runner, std::uint32_t seed) {
        std::mt19937 random(seed);
        runner.chunk = kPlaces[random() % kPlaces.size()];
        runner.around.resize(kFields.size());
        runner.fields.resize(kFields.size());
        for (std::size_t f = 0; f < kFields.size(); ++f) {
            for (ColumnValues& values : runner.around[f]) values = randomColumns(kFields[f], random);
            runner.fields[f] = runner.around[f][4];
        }
        runner.blocks = std::make_unique<BlockArray>(runner.graph.heights);
        for (std::uint16_t& block : *runner.blocks) block = static_cast<std::uint16_t>(random());
        for (auto& blocks : runner.blocksAround) blocks = std::make_unique<BlockArray>(*runner.blocks);
        for (std::size_t n = 0; n < runner.blocksAround.size(); ++n) {
            std::rotate(runner.blocksAround[n]->begin(),
                        runner.blocksAround[n]->begin() + 1 + static_cast<long>(n),
                        runner.blocksAround[n]->end());
        }
    }

  private:
    static constexpr std::array<Type, 4> kFields = {Type::Float, Type::Int, Type::Bool, Type::Float};

    std::uint32_t below(std::uint32_t n) { return random_() % n; }

    NodeId add(Op op, Type type, std::initializer_list<NodeId> args, std::uint32_t imm = 0,
               std::uint8_t dependence = kDependsNone) {
        const NodeId id = pass_.graph.add(op, type, {args.begin(), args.size()}, imm, dependence);
        push(type, id);
        return id;
    }

    void push(Type type, NodeId id) { nodes_[static_cast<std::size_t>(type)].push_back(id); }

    // Mostly something new, so that chains grow deep and branches have nodes of their own.
    NodeId pick(Type type) {
        const auto& nodes = nodes_[static_cast<std::size_t>(type)];
        const auto count = static_cast<std::uint32_t>(nodes.size());
        const std::uint32_t newest = std::min(count, 5u);
        return nodes[below(3) == 0 ? below(count) : count - 1 - below(newest)];
    }

    void addLeaves() {
        for (const Type type : {Type::Float, Type::Int, Type::Bool}) {
            for (int k = 0; k < 4; ++k) push(type, pass_.graph.constant(type, randomBits(type, random_)));
        }
        add(Op::PosX, Type::Int, {}, 0, kDependsColumn);
        add(Op::PosY, Type::Int, {}, 0, kDependsColumn);
        if (pass_.is3D) add(Op::PosZ, Type::Int, {}, 0, kDependsZ);
        for (std::uint32_t f = 0; f < kFields.size(); ++f) add(Op::Field, kFields[f], {}, f, kDependsColumn);
    }

    void grow(int depth) {
        const std::uint32_t choice = below(10);
        if (choice == 0) return addRead();
        if (choice <= 2 && depth < 4) return addIf(depth);
        if (hasLoops_ && choice == 3 && depth < 2 && below(3) == 0) return addLoop(depth);
        addOperation();
    }

    void addRead() {
        const std::uint32_t choice = below(pass_.is3D ? 12 : 8);
        if (choice == 0) return addStripes();
        if (choice == 1) return addNoise(4, kDependsColumn, 0, Type::Float);
        return addReadOf(choice - 2);
    }

    void addReadOf(std::uint32_t choice) {
        if (choice == 0) return addNoise(0, kDependsColumn, 0, Type::Float);
        if (choice == 1) {
            const std::uint32_t component = below(4);
            return addNoise(2, kDependsColumn, component, component < 2 ? Type::Float : Type::Int);
        }
        if (choice == 2) {
            const std::uint32_t seed = packHashSeed(below(2), below(3));
            add(Op::Hash2, Type::Int, {pick(Type::Int), pick(Type::Int)}, seed);
        } else if (choice == 3) {
            add(Op::Hash3, Type::Int, {pick(Type::Int), pick(Type::Int), pick(Type::Int)}, below(2));
        } else if (choice == 4) {
            addFieldAt();
        } else if (choice == 5) {
            add(Op::BlockInColumn, Type::Int, {pick(Type::Int)}, 0, kDependsColumn);
        } else if (choice == 6) {
            add(Op::BlockHere, Type::Int, {}, 0, kDependsVoxel);
        } else if (choice == 7) {
            addNoise(1, kDependsVoxel, 0, Type::Float);
        } else if (choice == 8) {
            const std::uint32_t component = below(5);
            addNoise(3, kDependsVoxel, component, component < 2 ? Type::Float : Type::Int);
        } else {
            pass_.readsBlocksAt = true;
            add(Op::BlockAt, Type::Int, {pick(Type::Int), pick(Type::Int), pick(Type::Int)}, 0,
                kDependsColumn);
        }
    }

    void addNoise(std::uint32_t call, std::uint8_t dependence, std::uint32_t component, Type type) {
        const NodeId noise = pass_.graph.add(Op::Noise, Type::Float, {}, call, dependence);
        add(Op::Component, type, {noise}, component);
    }

    void addStripes() {
        const NodeId across[] = {pick(Type::Float), pick(Type::Float)};
        const NodeId stripes = pass_.graph.add(Op::Stripes, Type::Float, across, 5, kDependsColumn);
        add(Op::Component, Type::Float, {stripes}, below(2));
    }

    void addFieldAt() {
        const std::uint32_t field = below(4);
        auto& readsAt = pass_.readsAt;
        if (std::find(readsAt.begin(), readsAt.end(), field) == readsAt.end()) readsAt.push_back(field);
        add(Op::FieldAt, kFields[field], {pick(Type::Int), pick(Type::Int)}, field, kDependsColumn);
    }

    void addOperation() {
        const auto first = static_cast<std::uint32_t>(Op::AddF), end = static_cast<std::uint32_t>(Op::Phi);
        const OpRecord& r = record(static_cast<Op>(first + below(end - first)));
        const bool isChoice = r.op == Op::Select;
        const Type result = isChoice ? static_cast<Type>(below(3)) : r.result;
        std::vector<NodeId> args;
        for (std::size_t k = 0; k < r.argCount; ++k)
            args.push_back(pick(isChoice && k > 0 ? result : r.argTypes[k]));
        push(result, pass_.graph.add(r.op, result, args));
    }

    // Grows both sides, then joins one to three values.
    void addIf(int depth) {
        const NodeId condition = pick(Type::Bool);
        std::array<std::array<NodeId, 3>, 2> sides;
        for (auto& side : sides) {
            for (std::uint32_t k = 1 + below(5); k > 0; --k) grow(depth + 1);
            for (std::uint32_t t = 0; t < 3; ++t) side[t] = pick(static_cast<Type>(t));
        }
        const std::uint32_t number = pass_.graph.newIf(), first = below(3), count = 1 + below(3);
        for (std::uint32_t t = first; t < first + count; ++t) {
            add(Op::Phi, static_cast<Type>(t % 3), {condition, sides[0][t % 3], sides[1][t % 3]}, number);
        }
    }

    // Two or three variables that change for up to nine rounds. What is made in the loop stays in it, and so
    // does what random operations make of it.
    void addLoop(int depth) {
        Graph& g = pass_.graph;
        const auto outside = nodes_;
        const std::uint8_t dependence = pass_.is3D ? kDependsVoxel : kDependsColumn;
        const NodeId zero = g.constant(Type::Int, 0), rounds = g.constant(Type::Int, below(10));
        const std::array<NodeId, 3> initial = {zero, pick(Type::Float), pick(Type::Int)};
        g.beginLoop();
        std::vector<std::uint32_t> variables;
        for (const NodeId id : initial) {
            variables.push_back(g.addLoopVariable(g.node(id).type, id, dependence));
            push(g.node(id).type, g.loopVariable(variables.back()).in);
        }
        for (std::uint32_t k = 2 + below(8); k > 0; --k) grow(depth + 2);
        const NodeId count = g.loopVariable(variables[0]).in;
        const auto node = [&](Op op, Type type, std::initializer_list<NodeId> args) {
            return g.add(op, type, {args.begin(), args.size()});
        };
        const NodeId isEarly = node(Op::LessI, Type::Bool, {count, rounds});
        const NodeId condition = node(Op::And, Type::Bool, {isEarly, pick(Type::Bool)});
        const std::array<NodeId, 3> next = {node(Op::AddI, Type::Int, {count, g.constant(Type::Int, 1)}),
                                            pick(Type::Float), below(4) == 0 ? count : pick(Type::Int)};
        g.endLoop(condition, next);
        nodes_ = outside;
        for (const std::uint32_t v : variables) {
            const NodeId out = g.loopVariable(v).out;
            push(g.node(out).type, out);
        }
    }

    // One number that hangs from many nodes.
    NodeId mixed() {
        NodeId sum = pick(Type::Int);
        const NodeId factor = pass_.graph.constant(Type::Int, 31);
        for (int k = 0; k < 4; ++k) {
            const NodeId number = add(Op::FloatToInt, Type::Int, {pick(Type::Float)});
            const NodeId chosen =
                add(Op::Select, Type::Int, {pick(Type::Bool), pick(Type::Int), pick(Type::Int)});
            const NodeId both = add(Op::AddI, Type::Int, {number, chosen});
            sum = add(Op::AddI, Type::Int, {add(Op::MulI, Type::Int, {sum, factor}), both});
        }
        return sum;
    }

    std::mt19937 random_;
    bool hasLoops_;
    PassGraph pass_;
    std::array<std::vector<NodeId>, 3> nodes_;  // by type
};

}  // namespace terrane::gen
