// The expression graph of one pass: pure nodes, arguments before their users, equal nodes stored once.
// Built through builder.h, scheduled by program.h. Used on one thread while a generator is built.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "terrane/gen/op.h"

namespace terrane::gen {

using NodeId = std::uint32_t;

// What a node's value depends on, as a set of bits. A value that depends on neither is the same everywhere.
enum Dependence : std::uint8_t { kDependsNone = 0, kDependsColumn = 1, kDependsZ = 2, kDependsVoxel = 3 };

struct Node {
    Op op = Op::Constant;
    Type type = Type::Int;
    std::uint8_t dependence = kDependsNone;
    std::array<NodeId, 3> args{};
    std::uint32_t imm = 0;

    std::span<const NodeId> arguments() const { return {args.data(), record(op).argCount}; }
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

  private:
    struct KeyHash {
        std::size_t operator()(const Node& n) const;
    };
    struct KeyEqual {
        bool operator()(const Node& a, const Node& b) const;
    };

    NodeId intern(const Node& node);

    std::vector<Node> nodes_;
    std::unordered_map<Node, NodeId, KeyHash, KeyEqual> ids_;
    std::uint32_t ifCount_ = 0;
};

}  // namespace terrane::gen
