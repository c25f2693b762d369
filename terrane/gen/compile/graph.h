// The expression graph of one pass: pure nodes, arguments before their users, equal nodes stored once. Built
// through builder.h, scheduled by program.h. It is used on one thread while a generator is built.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "terrane/gen/compile/op.h"

namespace terrane::gen {

using NodeId = std::uint32_t;

// Dependence of a node's value, as a set of bits. A value with neither bit is the same everywhere.
enum Dependence : std::uint8_t { kDependsNone = 0, kDependsColumn = 1, kDependsZ = 2, kDependsVoxel = 3 };

constexpr std::int32_t kNoLoop = -1;

struct Node {
    Op op = Op::Constant;
    Type type = Type::Int;
    std::uint8_t dependence = kDependsNone;
    std::int32_t loop = kNoLoop;  // innermost one whose variables its value depends on
    std::array<NodeId, 3> args{};
    std::uint32_t imm = 0;

    std::span<const NodeId> arguments() const { return {args.data(), record(op).argCount}; }
};

// A value that changes from round to round of a loop. While the condition holds, all variables take their
// next values at once. A loop ends after shared::kMaxLoopRounds rounds in any case.
struct LoopVariable {
    std::int32_t loop = kNoLoop;
    NodeId initial = 0, in = 0, next = 0, out = 0;
};

struct Loop {
    std::int32_t parent = kNoLoop;  // the loop around it
    int depth = 0;
    NodeId condition = 0;
    std::vector<std::uint32_t> variables;
};

class Graph {
  public:
    NodeId constant(Type type, Bits bits);
    // Adds a node or finds an equal one; constant arguments are folded. `dependence` is added to the
    // arguments'.
    NodeId add(Op op, Type type, std::span<const NodeId> args, std::uint32_t imm = 0,
               std::uint8_t dependence = kDependsNone);

    const Node& node(NodeId id) const { return nodes_[id]; }
    std::size_t size() const { return nodes_.size(); }
    bool isConstant(NodeId id) const { return nodes_[id].op == Op::Constant; }

    std::uint32_t newIf() { return ifCount_++; }
    std::uint32_t ifCount() const { return ifCount_; }

    // Nodes added between beginLoop and endLoop are the loop's as far as they depend on its variables.
    std::int32_t beginLoop();
    // Returns the number of a new variable of the innermost open loop. Its `in` is its value in the round.
    // `dependence`: of the values that it will have.
    std::uint32_t addLoopVariable(Type type, NodeId initial, std::uint8_t dependence);
    // Sets `next` of each variable, in order. From here on the variables' `out` are their last values.
    void endLoop(NodeId condition, std::span<const NodeId> next);
    const std::vector<Loop>& loops() const { return loops_; }
    const LoopVariable& loopVariable(std::uint32_t number) const { return loopVariables_[number]; }
    // Returns whether some node outside of a loop depends on a node inside otherwise than through a
    // variable's `out`.
    bool leaksOutOfLoop() const { return leaksOutOfLoop_; }

    // Returns a node that stands for a value of another graph, which has no node in this one.
    NodeId foreignValue(Type type);
    bool usesForeignValue() const { return usesForeignValue_; }

    // Returns a copy with the same node numbers in which some conditions are known: they become constants,
    // and nodes that depend on z are simplified. `standIn`, by node: the node that has its value in the copy.
    // Nothing can be added to the copy.
    struct Known {
        NodeId condition;
        bool holds;
    };
    Graph withKnown(std::span<const Known> known, std::vector<NodeId>& standIn) const;

  private:
    struct KeyHash {
        std::size_t operator()(const Node& n) const;
    };
    struct KeyEqual {
        bool operator()(const Node& a, const Node& b) const;
    };

    NodeId intern(const Node& node);
    NodeId simplifyAgain(NodeId id, const std::vector<NodeId>& standIn);
    int depth(std::int32_t loop) const;
    bool isOpen(std::int32_t loop) const;

    std::vector<Node> nodes_;
    std::unordered_map<Node, NodeId, KeyHash, KeyEqual> ids_;
    std::uint32_t ifCount_ = 0;
    std::vector<Loop> loops_;
    std::vector<LoopVariable> loopVariables_;
    std::int32_t openLoop_ = kNoLoop;
    bool leaksOutOfLoop_ = false, usesForeignValue_ = false;
};

}  // namespace terrane::gen
