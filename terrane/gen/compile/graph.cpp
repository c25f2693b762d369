#include "terrane/gen/compile/graph.h"

#include <cassert>
#include <optional>
#include <utility>

#include "terrane/shared/hash.h"

namespace terrane::gen {
namespace {

bool isChoice(Op op) {
    return op == Op::Select || op == Op::Phi;
}

// The argument that a node always equals, where that is exact for every value (float zeros have signs, so x +
// 0.0 is not x).
std::optional<NodeId> simplified(const Graph& graph, const Node& n) {
    const auto constantIs = [&](int arg, Bits bits) {
        const Node& a = graph.node(n.args[static_cast<std::size_t>(arg)]);
        return a.op == Op::Constant && a.imm == bits;
    };
    if (isChoice(n.op)) {
        if (n.args[1] == n.args[2]) return n.args[1];
        if (graph.isConstant(n.args[0])) return asBool(graph.node(n.args[0]).imm) ? n.args[1] : n.args[2];
    }
    if (n.op == Op::MulF && constantIs(1, bitsOf(1.0f))) return n.args[0];
    if (n.op == Op::AddI && constantIs(1, 0)) return n.args[0];
    if (n.op == Op::MulI && constantIs(1, 1)) return n.args[0];
    if (n.op == Op::And) {
        if (constantIs(1, ~Bits{0}) || n.args[0] == n.args[1]) return n.args[0];
        if (constantIs(1, 0)) return n.args[1];
    }
    if (n.op == Op::Or) {
        if (constantIs(1, 0) || n.args[0] == n.args[1]) return n.args[0];
        if (constantIs(1, ~Bits{0})) return n.args[1];
    }
    return std::nullopt;
}

}  // namespace

std::size_t Graph::KeyHash::operator()(const Node& n) const {
    const auto head = static_cast<std::uint32_t>(n.op) << 8 | static_cast<std::uint32_t>(n.type);
    return shared::hash3(n.args[0], n.args[1], n.args[2], shared::hash2(head, n.imm, 0));
}

bool Graph::KeyEqual::operator()(const Node& a, const Node& b) const {
    return a.op == b.op && a.type == b.type && a.imm == b.imm && a.args == b.args;
}

NodeId Graph::constant(Type type, Bits bits) {
    Node n;
    n.type = type;
    n.imm = bits;
    return intern(n);
}

NodeId Graph::add(Op op, Type type, std::span<const NodeId> args, std::uint32_t imm,
                  std::uint8_t dependence) {
    const OpRecord& rec = record(op);
    assert(args.size() == rec.argCount && "an operation takes as many arguments as its record says");
    Node n;
    n.op = op;
    n.type = type;
    n.dependence = dependence;
    n.imm = imm;
    std::array<Bits, 3> values{};
    bool allConstant = rec.evaluate != nullptr;
    for (std::size_t k = 0; k < args.size(); ++k) {
        // Only a graph that was moved from has lost its nodes.
        if (args[k] >= nodes_.size()) return foreignValue(type);
        n.args[k] = args[k];
        n.dependence |= nodes_[args[k]].dependence;
        const std::int32_t loop = nodes_[args[k]].loop;
        if (!isOpen(loop)) leaksOutOfLoop_ = true;
        if (depth(loop) > depth(n.loop)) n.loop = loop;
        allConstant = allConstant && isConstant(args[k]);
        values[k] = nodes_[args[k]].imm;
    }
    if (allConstant) return constant(type, rec.evaluate(values));
    // Constants second, else by number: equal sums meet whatever the order they were written in.
    if (isCommutative(op) && (isConstant(n.args[0]) || (!isConstant(n.args[1]) && n.args[0] > n.args[1]))) {
        std::swap(n.args[0], n.args[1]);
    }
    if (const auto same = simplified(*this, n)) return *same;
    return intern(n);
}

NodeId Graph::foreignValue(Type type) {
    usesForeignValue_ = true;
    return constant(type, 0);
}

int Graph::depth(std::int32_t loop) const {
    return loop == kNoLoop ? 0 : loops_[static_cast<std::size_t>(loop)].depth;
}

bool Graph::isOpen(std::int32_t loop) const {
    std::int32_t open = openLoop_;
    while (open != loop && open != kNoLoop) open = loops_[static_cast<std::size_t>(open)].parent;
    return open == loop;
}

std::int32_t Graph::beginLoop() {
    Loop loop;
    loop.parent = openLoop_;
    loop.depth = depth(openLoop_) + 1;
    openLoop_ = static_cast<std::int32_t>(loops_.size());
    loops_.push_back(loop);
    return openLoop_;
}

std::uint32_t Graph::addLoopVariable(Type type, NodeId initial, std::uint8_t dependence) {
    assert(openLoop_ != kNoLoop && "variables belong to the loop that is open");
    const auto number = static_cast<std::uint32_t>(loopVariables_.size());
    const NodeId args[] = {initial};
    const NodeId in = add(Op::LoopIn, type, args, number, dependence);
    nodes_[in].loop = openLoop_;
    loopVariables_.push_back({openLoop_, initial, in, in, in});
    loops_[static_cast<std::size_t>(openLoop_)].variables.push_back(number);
    return number;
}

void Graph::endLoop(NodeId condition, std::span<const NodeId> next) {
    Loop& loop = loops_[static_cast<std::size_t>(openLoop_)];
    assert(next.size() == loop.variables.size() && "each variable has a next value");
    loop.condition = condition;
    leaksOutOfLoop_ = leaksOutOfLoop_ || !isOpen(nodes_[condition].loop);
    for (std::size_t k = 0; k < next.size(); ++k) {
        LoopVariable& v = loopVariables_[loop.variables[k]];
        v.next = next[k];
        leaksOutOfLoop_ = leaksOutOfLoop_ || !isOpen(nodes_[next[k]].loop);
        const NodeId args[] = {v.in};
        v.out = add(Op::LoopOut, nodes_[v.in].type, args, loop.variables[k]);
        nodes_[v.out].loop = loop.parent;
    }
    openLoop_ = loop.parent;
}

namespace {

// Whether a node depends on z through its arguments alone. Of operations not named here nothing is known.
bool hasZOfArgumentsOnly(Op op) {
    switch (op) {
        case Op::BlockInColumn:
        case Op::BlockAt:
        case Op::FieldAt:
        case Op::Component:
        case Op::Hash2:
        case Op::Hash3:
            return true;
        default:
            return record(op).evaluate != nullptr;
    }
}

}  // namespace

Graph Graph::withKnown(std::span<const Known> known, std::vector<NodeId>& standIn) const {
    Graph copy;
    copy.nodes_ = nodes_;
    copy.ifCount_ = ifCount_;
    copy.loops_ = loops_;
    copy.loopVariables_ = loopVariables_;
    for (const Known& k : known) {
        Node n;
        n.type = Type::Bool;
        n.imm = bitsOf(k.holds);
        copy.nodes_[k.condition] = n;
    }
    standIn.resize(nodes_.size());
    for (NodeId id = 0; id < nodes_.size(); ++id) {
        standIn[id] = id;
        if (copy.nodes_[id].dependence & kDependsZ) standIn[id] = copy.simplifyAgain(id, standIn);
    }
    for (Loop& l : copy.loops_) l.condition = standIn[l.condition];
    for (LoopVariable& v : copy.loopVariables_) {
        v.initial = standIn[v.initial];
        v.next = standIn[v.next];
    }
    return copy;
}

// With arguments that were simplified before it. Returns the node that has its value.
NodeId Graph::simplifyAgain(NodeId id, const std::vector<NodeId>& standIn) {
    Node& n = nodes_[id];
    const std::size_t count = n.arguments().size();
    std::uint8_t ofArguments = kDependsNone;
    std::array<Bits, 3> values{};
    bool allConstant = count > 0 && record(n.op).evaluate != nullptr;
    for (std::size_t k = 0; k < count; ++k) {
        n.args[k] = standIn[n.args[k]];
        const Node& arg = nodes_[n.args[k]];
        ofArguments |= arg.dependence;
        allConstant = allConstant && arg.op == Op::Constant;
        values[k] = arg.imm;
    }
    if (allConstant) {
        Node folded;
        folded.type = n.type;
        folded.imm = record(n.op).evaluate(std::span(values).first(count));
        n = folded;
        return id;
    }
    if (hasZOfArgumentsOnly(n.op) && !(ofArguments & kDependsZ)) {
        n.dependence = static_cast<std::uint8_t>(n.dependence & ~kDependsZ);
    }
    if (isCommutative(n.op) && isConstant(n.args[0])) std::swap(n.args[0], n.args[1]);
    return simplified(*this, n).value_or(id);
}

NodeId Graph::intern(const Node& node) {
    const auto [it, inserted] = ids_.try_emplace(node, static_cast<NodeId>(nodes_.size()));
    if (inserted) nodes_.push_back(node);
    return it->second;
}

}  // namespace terrane::gen
