#include "terrane/gen/compile/generator_graph.h"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "terrane/base/digest.h"

namespace terrane::gen {

std::vector<NodeId> outputsOf(const PassGraph& pass) {
    std::vector<NodeId> outputs;
    for (const FieldOutput& f : pass.fields) {
        outputs.push_back(f.value);
        if (f.isWritten) outputs.push_back(*f.isWritten);
    }
    if (pass.block) outputs.push_back(*pass.block);
    return outputs;
}

int last3DPassBefore(const GeneratorGraph& generator, int pass) {
    while (--pass >= 0 && !generator.passes[static_cast<std::size_t>(pass)].is3D) {
    }
    return pass;
}

int passesNeededAround(const GeneratorGraph& generator, int pass) {
    const PassGraph& graph = generator.passes[static_cast<std::size_t>(pass)];
    int needed = graph.readsBlocksAt ? last3DPassBefore(generator, pass) + 1 : 0;
    for (const std::uint32_t f : graph.readsAt) needed = std::max(needed, generator.fields[f].writtenBy + 1);
    return needed;
}

int sharedPasses(const GeneratorGraph& generator) {
    int shared = 0;
    for (int pass = 0; pass < static_cast<int>(generator.passes.size()); ++pass) {
        shared = std::max(shared, passesNeededAround(generator, pass));
    }
    return shared;
}

namespace {

// Collects values, each as 64 bits, so that no two lists of values are the same bytes.
class Values {
  public:
    template <class T>
    requires(std::is_integral_v<T> || std::is_enum_v<T>) void add(T value) {
        addBits(static_cast<std::uint64_t>(value));
    }
    void add(float value) { addBits(std::bit_cast<std::uint32_t>(value)); }
    void add(std::string_view text) {
        add(text.size());
        bytes_.append(text);
    }
    template <class List, class Each>
    void addList(const List& list, Each each) {
        add(list.size());
        for (const auto& item : list) each(item);
    }
    std::uint64_t hash() const { return base::hash64(bytes_); }

  private:
    void addBits(std::uint64_t bits) {
        for (int k = 0; k < 8; ++k) bytes_.push_back(static_cast<char>(bits >> (8 * k) & 0xFF));
    }

    std::string bytes_;
};

void add(Values& values, const NoiseCall& call) {
    values.add(call.kind);
    values.add(call.name);
    values.add(call.size);
    values.addList(call.weights, [&](float weight) { values.add(weight); });
    values.add(call.maxPoints);
    values.add(call.exponent);
}

// Objects that nodes refer to by number. Numbers follow the order of recording, so they are not hashed.
struct Calls {
    const std::vector<NoiseCall>& noises;
    const std::vector<std::string>& hashNames;
    const std::vector<StampCall>& stamps;
};

void addImm(Values& values, const Node& node, const Calls& calls) {
    switch (node.op) {
        case Op::Noise:
        case Op::Stripes:
            add(values, calls.noises[node.imm]);
            break;
        case Op::Hash2:
        case Op::Hash3:
            values.add(calls.hashNames[hashSlot(node.imm)]);
            values.add(hashOctave(node.imm));
            break;
        case Op::Stamp:
            values.add(calls.stamps[node.imm].shape);
            values.add(calls.stamps[node.imm].base);
            break;
        case Op::Phi:  // which if it is
            break;
        default:
            values.add(node.imm);
    }
}

// Hashes of a pass's values by what they are computed from, whatever the order in which nodes and calls were
// recorded: C++ leaves the order of arguments to the compiler.
class NodeHashes {
  public:
    NodeHashes(const Graph& graph, const Calls& calls);
    std::uint64_t operator[](NodeId id) const { return hashes_[id]; }

  private:
    std::uint64_t hashOf(const Node& node, const Calls& calls) const;
    std::uint64_t hashOfLoopValue(const Node& node);
    std::uint64_t loopHash(std::int32_t loop);
    bool changes(const LoopVariable& variable) const { return variable.next != variable.in; }

    const Graph& graph_;
    std::vector<std::uint64_t> hashes_;  // by node
    std::vector<std::uint32_t> places_;  // by loop variable, among those of its loop that change
    std::vector<std::optional<std::uint64_t>> ofLoops_;  // by loop
};

NodeHashes::NodeHashes(const Graph& graph, const Calls& calls)
    : graph_(graph), ofLoops_(graph.loops().size()) {
    for (const Loop& loop : graph.loops()) {
        std::uint32_t count = 0;
        for (const std::uint32_t variable : loop.variables) {
            places_.resize(std::max<std::size_t>(places_.size(), variable + 1));
            places_[variable] = count;
            count += changes(graph.loopVariable(variable));
        }
    }
    hashes_.reserve(graph.size());
    for (NodeId id = 0; id < graph.size(); ++id) {
        const Node& node = graph.node(id);
        const bool isOfLoop = node.op == Op::LoopIn || node.op == Op::LoopOut;
        hashes_.push_back(isOfLoop ? hashOfLoopValue(node) : hashOf(node, calls));
    }
}

std::uint64_t NodeHashes::hashOf(const Node& node, const Calls& calls) const {
    std::array<std::uint64_t, 3> arguments{};
    const std::size_t count = node.arguments().size();
    for (std::size_t k = 0; k < count; ++k) arguments[k] = hashes_[node.args[k]];
    if (isCommutative(node.op) && arguments[1] < arguments[0]) std::swap(arguments[0], arguments[1]);
    Values values;
    values.add(node.op);
    values.add(node.type);
    values.addList(std::span(arguments).first(count), [&](std::uint64_t hash) { values.add(hash); });
    addImm(values, node, calls);
    return values.hash();
}

// A variable that does not change in a loop has its initial value there and after it. Other variables are
// told apart by the depth of their loop and by their place in it, after the loop by its hash.
std::uint64_t NodeHashes::hashOfLoopValue(const Node& node) {
    const LoopVariable& variable = graph_.loopVariable(node.imm);
    if (!changes(variable)) return hashes_[variable.initial];
    Values values;
    values.add(node.op);
    values.add(node.type);
    values.add(places_[node.imm]);
    if (node.op == Op::LoopIn)
        values.add(graph_.loops()[static_cast<std::size_t>(variable.loop)].depth);
    else
        values.add(loopHash(variable.loop));
    return values.hash();
}

// All nodes of a loop stand before what reads its results.
std::uint64_t NodeHashes::loopHash(std::int32_t number) {
    std::optional<std::uint64_t>& known = ofLoops_[static_cast<std::size_t>(number)];
    if (known) return *known;
    const Loop& loop = graph_.loops()[static_cast<std::size_t>(number)];
    Values values;
    values.add(hashes_[loop.condition]);
    for (const std::uint32_t k : loop.variables) {
        const LoopVariable& variable = graph_.loopVariable(k);
        if (!changes(variable)) continue;
        values.add(hashes_[variable.initial]);
        values.add(hashes_[variable.next]);
    }
    known = values.hash();
    return *known;
}

void add(Values& values, const PassGraph& pass, const std::vector<NoiseCall>& noises,
         const std::vector<std::string>& hashNames) {
    const NodeHashes hashes(pass.graph, {noises, hashNames, pass.stamps});
    values.add(pass.is3D);
    values.addList(pass.fields, [&](const FieldOutput& output) {
        values.add(output.field);
        values.add(hashes[output.value]);
        values.add(output.isWritten.has_value());
        if (output.isWritten) values.add(hashes[*output.isWritten]);
    });
    values.add(pass.block.has_value());
    if (pass.block) values.add(hashes[*pass.block]);
}

void add(Values& values, const DrainageSpec& spec) {
    for (const int value : {spec.spacing, spec.minFlow, spec.lakeNodes}) values.add(value);
    for (const float value : {spec.seaLevel, spec.halfWidth, spec.maxHalfWidth, spec.reach, spec.bend,
                              spec.lakeDepth, spec.maxCut})
        values.add(value);
}

void add(Values& values, const DrainageGraph& map) {
    values.add(map.name);
    add(values, map.spec);
    add(values, map.heights, map.noises, map.hashNames);
}

void add(Values& values, const ShapeTable& table) {
    values.addList(table.shapes, [&](const ShapeRecord& shape) {
        for (const std::uint32_t first : shape.firstRun) values.add(first);
    });
    values.addList(table.runs, [&](const ShapeRun& run) {
        for (const int value : {int{run.x}, int{run.y}, int{run.z}, int{run.length}}) values.add(value);
        values.add(run.block);
    });
}

}  // namespace

std::uint64_t graphHash(const GeneratorGraph& generator) {
    Values values;
    values.add(generator.level);
    values.addList(generator.fields, [&](const FieldInfo& field) {
        values.add(field.type);
        values.add(field.writtenBy);
    });
    values.addList(generator.drainages, [&](const DrainageGraph& map) { add(values, map); });
    values.addList(generator.passes,
                   [&](const PassGraph& pass) { add(values, pass, generator.noises, generator.hashNames); });
    values.add(generator.shapes != nullptr);
    if (generator.shapes) add(values, *generator.shapes);
    if (generator.heights != world::Heights()) {
        values.add(generator.heights.bottom);
        values.add(generator.heights.top);
    }
    return values.hash();
}

std::uint32_t seedOf(const std::string& name, std::uint64_t worldSeed) {
    return static_cast<std::uint32_t>(XXH3_64bits_withSeed(name.data(), name.size(), worldSeed));
}

Seeds makeSeeds(const GeneratorGraph& generator, std::uint64_t worldSeed) {
    return makeSeeds(generator.noises, generator.hashNames, worldSeed);
}

Seeds makeSeeds(const std::vector<NoiseCall>& noises, const std::vector<std::string>& hashNames,
                std::uint64_t worldSeed) {
    Seeds seeds;
    for (const NoiseCall& call : noises) seeds.noises.push_back(seedOf(noiseSeedName(call.name), worldSeed));
    for (const std::string& name : hashNames) seeds.hashes.push_back(seedOf(name, worldSeed));
    return seeds;
}

}  // namespace terrane::gen
