#include "terrane/gen/builder.h"

#include <fmt/ranges.h>

#include <algorithm>

namespace terrane::gen {

Pass::Pass(GeneratorBuilder& generator, int number, std::string name, bool is3D)
    : generator_(generator), number_(number) {
    graph_.name = std::move(name);
    graph_.is3D = is3D;
    if (is3D) {
        const bool first = generator.newest3D() < 0;
        blockSlot_ = newSlot(Type::Int, first ? Value(Block(world::kAir)) : Value(blockHere()));
        return;
    }
    fieldSlots_.resize(generator.generator_.fields.size());
    for (std::size_t k = 0; k < fieldSlots_.size(); ++k) {
        const FieldInfo& info = generator.generator_.fields[k];
        if (info.writtenBy < 0) fieldSlots_[k] = newSlot(info.type, Value{nullptr, 0});
    }
}

void Pass::error(std::string_view message) {
    auto& errors = generator_.errors_;
    std::string full = fmt::format("pass \"{}\": {}", graph_.name, message);
    // A mistake in an expression that is written several times counts once.
    if (std::find(errors.begin(), errors.end(), full) == errors.end()) errors.push_back(std::move(full));
}

bool Pass::require3D(std::string_view what) {
    if (!graph_.is3D) error(fmt::format("{}: only in 3D passes", what));
    return graph_.is3D;
}

Value Pass::leaf(Op op, Type type, std::uint32_t imm, std::uint8_t dependence) {
    return {&graph_.graph, graph_.graph.add(op, type, {}, imm, dependence)};
}

Int Pass::x() {
    return Int(leaf(Op::PosX, Type::Int, 0, kDependsColumn));
}
Int Pass::y() {
    return Int(leaf(Op::PosY, Type::Int, 0, kDependsColumn));
}
Int Pass::z() {
    if (!require3D("z")) return 0;
    return Int(leaf(Op::PosZ, Type::Int, 0, kDependsZ));
}

Block Pass::block(std::string_view name) {
    if (name == "air") return Block(world::kAir);
    const world::BlockType* type = generator_.blocks_.find(name);
    if (!type) error(fmt::format("unknown block \"{}\"", name));
    return Block(type ? type->id : generator_.blocks_.missing());
}

std::size_t Pass::newSlot(Type type, Value value) {
    slots_.push_back({type, value.nodeIn(graph_.graph, type)});
    return slots_.size() - 1;
}

void Pass::assign(std::size_t slot, Value value) {
    slots_[slot].value = value.nodeIn(graph_.graph, slots_[slot].type);
}

// Runs both branches on the slots' values and joins the slots that came out different.
void Pass::if_(Bool condition, const std::function<void()>& then, const std::function<void()>& otherwise) {
    const NodeId conditionNode = condition.nodeIn(graph_.graph, Type::Bool);
    const std::vector<Slot> before = slots_;
    if (then) then();
    const std::vector<Slot> afterThen = slots_;
    // Variables made inside a branch end with it; outputs made there exist in the other branch with their
    // first value.
    for (std::size_t k = 0; k < before.size(); ++k) slots_[k] = before[k];
    if (otherwise) otherwise();

    const std::uint32_t number = graph_.graph.newIf();
    for (std::size_t k = 0; k < before.size(); ++k) {
        const NodeId args[] = {conditionNode, afterThen[k].value, slots_[k].value};
        slots_[k].value = graph_.graph.add(Op::Phi, slots_[k].type, args, number);
    }
}

Value Pass::noise(NoiseCall call, std::uint32_t result, Type type) {
    const bool is3D = call.kind == NoiseKind::Perlin3D;
    const std::uint32_t index = generator_.noiseIndex(*this, std::move(call));
    const Value value = leaf(Op::Noise, Type::Float, index, is3D ? kDependsVoxel : kDependsColumn);
    return applyOp(Op::Component, type, {value}, result);
}

Float Pass::perlin2D(std::string_view name, int size, std::vector<float> weights) {
    return Float(noise({NoiseKind::Perlin2D, std::string(name), size, std::move(weights)}, 0, Type::Float));
}

Float Pass::perlin3D(std::string_view name, int size, std::vector<float> weights) {
    if (!require3D("perlin3D")) return 0.0f;
    return Float(noise({NoiseKind::Perlin3D, std::string(name), size, std::move(weights)}, 0, Type::Float));
}

Voronoi2D Pass::voronoi2D(std::string_view name, int size, int maxPoints) {
    const auto result = [&](VoronoiResult r, Type type) {
        return noise({NoiseKind::Voronoi2D, std::string(name), size, {}, maxPoints}, r, type);
    };
    return {Float(result(kVoronoiDistance, Type::Float)),
            Float(result(kVoronoiRatio, Type::Float)),
            {Int(result(kVoronoiOffsetX, Type::Int)), Int(result(kVoronoiOffsetY, Type::Int))}};
}

Float Pass::random2D(std::string_view name, Int px, Int py) {
    const std::uint32_t slot = generator_.randomSlot(name);
    Graph& g = graph_.graph;
    const NodeId args[] = {px.nodeIn(g, Type::Int), py.nodeIn(g, Type::Int)};
    return Float(Value{&g, g.add(Op::Random2D, Type::Float, args, slot)});
}

Float Pass::random3D(std::string_view name, Int px, Int py, Int pz) {
    const std::uint32_t slot = generator_.randomSlot(name);
    Graph& g = graph_.graph;
    const NodeId args[] = {px.nodeIn(g, Type::Int), py.nodeIn(g, Type::Int), pz.nodeIn(g, Type::Int)};
    return Float(Value{&g, g.add(Op::Random3D, Type::Float, args, slot)});
}

bool Pass::requireWritten(std::uint32_t field) {
    const FieldInfo& info = generator_.generator_.fields[field];
    const bool earlier = info.writtenBy >= 0 && info.writtenBy < number_;
    if (!earlier) error(fmt::format("field \"{}\" is read, but no earlier pass writes it", info.name));
    return earlier;
}

bool Pass::requireBlocks() {
    const bool earlier = generator_.newest3D() >= 0;
    if (!earlier) error("blocks are read, but no earlier 3D pass sets them");
    return earlier;
}

Value Pass::readField(std::uint32_t field, Type type) {
    requireWritten(field);
    return leaf(Op::Field, type, field, kDependsColumn);
}

Value Pass::readFieldAt(std::uint32_t field, Type type, IVec2 offset) {
    requireWritten(field);
    for (const Int& o : {offset.x, offset.y}) {
        const bool isLiteral = o.graph == nullptr;
        if (isLiteral && (asInt(o.bits) < -kMaxReadOffset || asInt(o.bits) > kMaxReadOffset)) {
            error(fmt::format("field \"{}\": offset {} is beyond {} blocks",
                              generator_.generator_.fields[field].name, asInt(o.bits), kMaxReadOffset));
        }
    }
    auto& readsAt = graph_.readsAt;
    if (std::find(readsAt.begin(), readsAt.end(), field) == readsAt.end()) readsAt.push_back(field);
    Graph& g = graph_.graph;
    const NodeId args[] = {offset.x.nodeIn(g, Type::Int), offset.y.nodeIn(g, Type::Int)};
    return {&g, g.add(Op::FieldAt, type, args, field, kDependsColumn)};
}

void Pass::setField(std::uint32_t field, [[maybe_unused]] Type type, Value value) {
    FieldInfo& info = generator_.generator_.fields[field];
    assert(info.type == type && "a field's type is part of its C++ type");
    if (graph_.is3D) return error(fmt::format("field \"{}\": only 2D passes write fields", info.name));
    if (field >= fieldSlots_.size()) {
        return error(fmt::format("field \"{}\" is declared inside the pass that writes it", info.name));
    }
    if (info.writtenBy >= 0 && info.writtenBy != number_) {
        return error(fmt::format("field \"{}\" is written by an earlier pass", info.name));
    }
    info.writtenBy = number_;
    assign(*fieldSlots_[field], value);
}

Block Pass::blockHere() {
    if (!require3D("blockHere")) return Block(world::kAir);
    requireBlocks();
    return Block(leaf(Op::BlockHere, Type::Int, 0, kDependsVoxel));
}

Block Pass::blockInColumn(Int pz) {
    if (!requireBlocks()) return Block(world::kAir);
    Graph& g = graph_.graph;
    const NodeId args[] = {pz.nodeIn(g, Type::Int)};
    return Block(Value{&g, g.add(Op::BlockInColumn, Type::Int, args, 0, kDependsColumn)});
}

void Pass::setBlock(Block value) {
    if (!require3D("setBlock")) return;
    assign(*blockSlot_, value);
}

PassGraph Pass::finish() {
    for (std::size_t k = 0; k < fieldSlots_.size(); ++k) {
        const bool written = generator_.generator_.fields[k].writtenBy == number_;
        if (written) graph_.fields.push_back({static_cast<std::uint32_t>(k), slots_[*fieldSlots_[k]].value});
    }
    if (graph_.is3D) graph_.block = slots_[*blockSlot_].value;
    return std::move(graph_);
}

GeneratorBuilder::GeneratorBuilder(std::string name, const world::BlockRegistry& blocks) : blocks_(blocks) {
    generator_.name = std::move(name);
}

int GeneratorBuilder::newest3D() const {
    for (std::size_t k = generator_.passes.size(); k-- > 0;) {
        if (generator_.passes[k].is3D) return static_cast<int>(k);
    }
    return -1;
}

std::uint32_t GeneratorBuilder::newField(std::string_view name, Type type) {
    const auto sameName = [&](const FieldInfo& info) { return info.name == name; };
    if (std::any_of(generator_.fields.begin(), generator_.fields.end(), sameName)) {
        errors_.push_back(fmt::format("field \"{}\" is declared twice", name));
    }
    generator_.fields.push_back({std::string(name), type});
    return static_cast<std::uint32_t>(generator_.fields.size() - 1);
}

void GeneratorBuilder::addPass(std::string name, bool is3D, const std::function<void(Pass&)>& body) {
    Pass pass(*this, static_cast<int>(generator_.passes.size()), std::move(name), is3D);
    body(pass);
    generator_.passes.push_back(pass.finish());
}

namespace {

std::string noiseMistake(const NoiseCall& call) {
    if (call.size < 1 || call.size > 65536) return fmt::format("size {} is not in 1…65536", call.size);
    const bool isPerlin = call.kind != NoiseKind::Voronoi2D;
    if (isPerlin && (call.weights.empty() || call.weights.size() > 12)) return "takes 1 to 12 octave weights";
    if (isPerlin && (std::int64_t{call.size} << (call.weights.size() - 1)) > (1 << 20)) {
        return "the largest octave is beyond 2^20 blocks";
    }
    if (!isPerlin && call.size > kMaxVoronoiSize)
        return fmt::format("cells are at most {} blocks", kMaxVoronoiSize);
    if (!isPerlin && (call.maxPoints < 1 || call.maxPoints > 4)) {
        return fmt::format("{} points a cell, 1 to 4 are possible", call.maxPoints);
    }
    return "";
}

}  // namespace

std::uint32_t GeneratorBuilder::noiseIndex(Pass& pass, NoiseCall call) {
    const std::string mistake = noiseMistake(call);
    if (!mistake.empty()) {
        pass.error(fmt::format("noise \"{}\": {}", call.name, mistake));
        call = {call.kind, call.name, 16, {1.0f}, 1};
    }
    auto& noises = generator_.noises;
    for (std::size_t k = 0; k < noises.size(); ++k) {
        if (noises[k] == call) return static_cast<std::uint32_t>(k);
        if (noises[k].name == call.name) {
            pass.error(fmt::format("noise \"{}\" is used twice with different parameters", call.name));
        }
    }
    noises.push_back(std::move(call));
    return static_cast<std::uint32_t>(noises.size() - 1);
}

std::uint32_t GeneratorBuilder::randomSlot(std::string_view name) {
    auto& names = generator_.randomNames;
    const auto it = std::find(names.begin(), names.end(), name);
    if (it != names.end()) return static_cast<std::uint32_t>(it - names.begin());
    names.emplace_back(name);
    return static_cast<std::uint32_t>(names.size() - 1);
}

base::Result<GeneratorGraph> GeneratorBuilder::finish() {
    if (generator_.passes.empty() || !generator_.passes.back().is3D) {
        errors_.push_back("the last pass must be a 3D pass");
    }
    if (!errors_.empty()) {
        return base::fail("generator \"{}\": {}", generator_.name, fmt::join(errors_, "; "));
    }
    return std::move(generator_);
}

}  // namespace terrane::gen
