#include "terrane/gen/expr.h"

#include <cassert>

namespace terrane::gen {
namespace {

Type argumentType(const OpRecord& rec, std::size_t number, Type result) {
    const bool isSide = (rec.op == Op::Select || rec.op == Op::Phi) && number > 0;
    return isSide ? result : rec.argTypes[number];
}

}  // namespace

Value applyOp(Op op, Type result, std::initializer_list<Value> args, std::uint32_t imm) {
    const OpRecord& rec = record(op);
    assert(args.size() == rec.argCount && "an operation takes as many arguments as its record says");
    Graph* graph = nullptr;
    for (const Value& v : args) graph = v.graph ? v.graph : graph;

    std::array<Bits, 3> values{};
    std::size_t count = 0;
    for (const Value& v : args) {
        values[count] = graph ? v.nodeIn(*graph, argumentType(rec, count, result)) : v.bits;
        ++count;
    }
    if (!graph) return {nullptr, rec.evaluate(values)};
    return {graph, graph->add(op, result, {values.data(), count}, imm)};
}

}  // namespace terrane::gen
