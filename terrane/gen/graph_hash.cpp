#include "terrane/gen/graph_hash.h"

#include <bit>
#include <string>
#include <string_view>
#include <type_traits>

#include "terrane/base/digest.h"

namespace terrane::gen {
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

void add(Values& values, const Graph& graph) {
    values.add(graph.size());
    for (NodeId id = 0; id < graph.size(); ++id) {
        const Node& node = graph.node(id);
        values.add(node.op);
        values.add(node.type);
        values.add(node.dependence);
        values.add(node.loop);
        values.addList(node.arguments(), [&](NodeId argument) { values.add(argument); });
        values.add(node.imm);
    }
    std::uint32_t variables = 0;
    values.addList(graph.loops(), [&](const Loop& loop) {
        values.add(loop.parent);
        values.add(loop.condition);
        variables += static_cast<std::uint32_t>(loop.variables.size());
        values.addList(loop.variables, [&](std::uint32_t variable) { values.add(variable); });
    });
    for (std::uint32_t k = 0; k < variables; ++k) {
        const LoopVariable& variable = graph.loopVariable(k);
        for (const NodeId id : {variable.initial, variable.in, variable.next, variable.out}) values.add(id);
    }
}

void add(Values& values, const PassGraph& pass) {
    values.add(pass.is3D);
    add(values, pass.graph);
    values.addList(pass.fields, [&](const FieldOutput& output) {
        values.add(output.field);
        values.add(output.value);
        values.add(output.isWritten.has_value());
        values.add(output.isWritten.value_or(0));
    });
    values.add(pass.block.has_value());
    values.add(pass.block.value_or(0));
    values.addList(pass.readsAt, [&](std::uint32_t field) { values.add(field); });
    values.add(pass.readsBlocksAt);
    values.addList(pass.stamps, [&](const StampCall& stamp) {
        values.add(stamp.shape);
        values.add(stamp.base);
    });
}

void add(Values& values, const DrainageSpec& spec) {
    for (const int value : {spec.spacing, spec.minFlow, spec.lakeNodes}) values.add(value);
    for (const float value : {spec.seaLevel, spec.halfWidth, spec.maxHalfWidth, spec.reach, spec.bend,
                              spec.lakeDepth, spec.maxCut})
        values.add(value);
}

void addHashNames(Values& values, const std::vector<std::string>& names) {
    values.addList(names, [&](const std::string& name) { values.add(name); });
}

void add(Values& values, const DrainageGraph& map) {
    values.add(map.name);
    add(values, map.spec);
    values.addList(map.noises, [&](const NoiseCall& call) { add(values, call); });
    addHashNames(values, map.hashNames);
    add(values, map.heights);
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
    values.addList(generator.noises, [&](const NoiseCall& call) { add(values, call); });
    addHashNames(values, generator.hashNames);
    values.addList(generator.drainages, [&](const DrainageGraph& map) { add(values, map); });
    values.addList(generator.passes, [&](const PassGraph& pass) { add(values, pass); });
    values.add(generator.shapes != nullptr);
    if (generator.shapes) add(values, *generator.shapes);
    return values.hash();
}

}  // namespace terrane::gen
