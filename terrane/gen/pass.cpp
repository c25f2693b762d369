#include "terrane/gen/pass.h"

#include <algorithm>

#include "terrane/gen/builder.h"

namespace terrane::gen {

Pass::Pass(GeneratorBuilder& generator, int number, std::string name, bool is3D)
    : generator_(generator), number_(number) {
    graph_.name = std::move(name);
    graph_.is3D = is3D;
    if (is3D) {
        const bool first = generator.last3DPass() < 0;
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

int Pass::step() const {
    return generator_.step();
}

const std::vector<std::string>& Pass::mistakes() const {
    return generator_.mistakes();
}

Block Pass::block(std::string_view name) {
    if (name == "air") return Block(world::kAir);
    const world::BlockType* type = generator_.blocks_.find(name);
    if (!type) error(fmt::format("unknown block \"{}\"", name));
    return Block(type ? type->id : generator_.blocks_.missing());
}

std::size_t Pass::newSlot(Type type, Value value) {
    slots_.push_back({type, value.nodeIn(graph_.graph, type), false});
    return slots_.size() - 1;
}

void Pass::assign(std::size_t slot, Value value) {
    slots_[slot].value = value.nodeIn(graph_.graph, slots_[slot].type);
    slots_[slot].hasEnded = false;
}

// Runs both branches on the slots' values and joins the slots that came out different.
void Pass::if_(Bool condition, const std::function<void()>& then, const std::function<void()>& otherwise) {
    const NodeId conditionNode = condition.nodeIn(graph_.graph, Type::Bool);
    const std::vector<Slot> before = slots_;
    ++branchDepth_;
    if (then) then();
    const std::vector<Slot> afterThen = slots_;
    // Variables made in the first branch keep their slots, so that numbers of slots do not repeat; they are
    // not joined.
    for (std::size_t k = 0; k < before.size(); ++k) slots_[k] = before[k];
    if (otherwise) otherwise();
    --branchDepth_;

    const std::uint32_t number = graph_.graph.newIf();
    for (std::size_t k = 0; k < before.size(); ++k) {
        if (before[k].hasEnded) continue;
        const NodeId args[] = {conditionNode, afterThen[k].value, slots_[k].value};
        slots_[k].value = graph_.graph.add(Op::Phi, slots_[k].type, args, number);
    }
}

// Every variable may change in the loop; after it those that did have their last values, and those that were
// made in it have ended.
void Pass::while_(const std::function<Bool()>& condition, const std::function<void()>& body) {
    Graph& g = graph_.graph;
    const std::size_t count = slots_.size();
    const std::uint8_t dependence = graph_.is3D ? kDependsVoxel : kDependsColumn;
    struct Variable {
        std::size_t slot;
        std::uint32_t number;
    };
    std::vector<Variable> variables;
    g.beginLoop();
    for (std::size_t k = 0; k < count; ++k) {
        if (slots_[k].hasEnded) continue;
        variables.push_back({k, g.addLoopVariable(slots_[k].type, slots_[k].value, dependence)});
        slots_[k].value = g.loopVariable(variables.back().number).in;
    }
    ++branchDepth_;
    const NodeId conditionNode = condition().nodeIn(g, Type::Bool);
    body();
    --branchDepth_;
    std::vector<NodeId> next;
    for (const Variable& variable : variables) next.push_back(slots_[variable.slot].value);
    g.endLoop(conditionNode, next);
    for (const Variable& variable : variables) {
        const LoopVariable& v = g.loopVariable(variable.number);
        slots_[variable.slot].value = v.next == v.in ? v.initial : v.out;
    }
    for (std::size_t k = count; k < slots_.size(); ++k) slots_[k].hasEnded = true;
}

// False, with a message, where another pass writes the field.
bool Pass::claimField(std::uint32_t field) {
    FieldInfo& info = generator_.generator_.fields[field];
    if (info.writtenBy >= 0 && info.writtenBy != number_) {
        error(fmt::format("field \"{}\" is written by an earlier pass", info.name));
        return false;
    }
    info.writtenBy = number_;
    return true;
}

void Pass::setField(std::uint32_t field, Type type, Value value) {
    if (!requireField(field, type)) return;
    const FieldInfo& info = generator_.generator_.fields[field];
    if (graph_.is3D) return error(fmt::format("field \"{}\": 3D passes write fields with setAt", info.name));
    if (field >= fieldSlots_.size()) {
        return error(fmt::format("field \"{}\" is declared inside the pass that writes it", info.name));
    }
    if (claimField(field)) assign(*fieldSlots_[field], value);
}

void Pass::setFieldAt(std::uint32_t field, Type type, Int atZ, Value value) {
    if (!requireField(field, type) || !require3D("setAt")) return;
    const std::string name = generator_.generator_.fields[field].name;
    if (branchDepth_ > 0) return error(fmt::format("field \"{}\": setAt stands inside if_ or while_", name));
    if (generator_.generator_.fields[field].writtenBy == number_) {
        return error(fmt::format("field \"{}\" is set twice", name));
    }
    if (!claimField(field)) return;
    Graph& g = graph_.graph;
    const NodeId isThere = (z() == clamp(atZ, 0, world::kChunkHeight - 1)).nodeIn(g, Type::Bool);
    const NodeId args[] = {isThere, value.nodeIn(g, type), g.constant(type, 0)};
    graph_.fields.push_back({field, g.add(Op::Phi, type, args, g.newIf()), isThere});
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
    bool leaks = graph_.graph.leaksOutOfLoop();
    for (const NodeId output : outputsOf(graph_)) leaks = leaks || graph_.graph.node(output).loop != kNoLoop;
    if (leaks) error("a value made inside while_ is used after it: carry it out in a Var");
    if (graph_.graph.usesForeignValue())
        error("a value of another pass is used: write it to a field there and read it here");
    PassGraph done = std::move(graph_);
    graph_.graph = Graph();  // an expression that outlives the pass finds none of its nodes
    return done;
}

}  // namespace terrane::gen
