// Operators of expressions, and their comparisons, which Lua's own operators cannot be: those give booleans.

#include "terrane/lua/graph_call_internal.h"

namespace terrane::lua {
namespace {

using gen::Bool;
using gen::Float;
using gen::Int;

[[noreturn]] void noOperator(std::string_view sign, Kind kind) {
    std::string_view advice;
    if (sign == "/" && kind == Kind::Int) advice = ": write // for whole numbers, or float(a) / b";
    if (sign == "//" && kind == Kind::Float) advice = ": write floor(a / b)";
    fail("{} has no operator {}{}", nameOf(kind), sign, advice);
}

template <class T, class Operation>
int applyTo(GraphCall& c, std::string_view sign, Operation operation) {
    if constexpr (std::is_invocable_v<Operation, T, T>) {
        // In this order: each may name a block, and the version depends on the order of names.
        const T a = c.get<T>(1), b = c.get<T>(2);
        return c.push(operation(a, b));
    } else {
        noOperator(sign, kKindOf<T>);
    }
}

// The operation on two values of one kind, where the kind has it.
template <class Operation>
int binary(GraphCall& c, std::string_view sign, Operation operation) {
    const Kind kind = c.commonKind({1, 2});
    switch (kind) {
        case Kind::Bool:
            return applyTo<Bool>(c, sign, operation);
        case Kind::Int:
            return applyTo<Int>(c, sign, operation);
        case Kind::Float:
            return applyTo<Float>(c, sign, operation);
        case Kind::Block:
            return applyTo<gen::Block>(c, sign, operation);
        case Kind::Vec2:
            return applyTo<gen::Vec2>(c, sign, operation);
        case Kind::Vec3:
            return applyTo<gen::Vec3>(c, sign, operation);
        case Kind::IVec2:
            return applyTo<gen::IVec2>(c, sign, operation);
        default:
            noOperator(sign, kind);
    }
}

bool isVector(GraphCall& c, int argument) {
    const Expression* e = c.expression(argument);
    return e != nullptr && (e->kind == Kind::Vec2 || e->kind == Kind::Vec3);
}

// clang-format off
int add(GraphCall& c) { return binary(c, "+", [](auto a, auto b) -> decltype(a + b) { return a + b; }); }
int subtract(GraphCall& c) { return binary(c, "-", [](auto a, auto b) -> decltype(a - b) { return a - b; }); }
int equal(GraphCall& c) { return binary(c, ":eq", [](auto a, auto b) -> decltype(a == b) { return a == b; }); }
int notEqual(GraphCall& c) { return binary(c, ":ne", [](auto a, auto b) -> decltype(!(a == b)) { return !(a == b); }); }
int less(GraphCall& c) { return binary(c, ":lt", [](auto a, auto b) -> decltype(a < b) { return a < b; }); }
int lessEqual(GraphCall& c) { return binary(c, ":le", [](auto a, auto b) -> decltype(a <= b) { return a <= b; }); }
int greater(GraphCall& c) { return binary(c, ":gt", [](auto a, auto b) -> decltype(b < a) { return b < a; }); }
int greaterEqual(GraphCall& c) { return binary(c, ":ge", [](auto a, auto b) -> decltype(b <= a) { return b <= a; }); }
int divide(GraphCall& c) { return binary(c, "/", [](auto a, auto b) -> decltype(a / b) { return a / b; }); }
int shiftLeft(GraphCall& c) { return binary(c, "<<", [](auto a, auto b) -> decltype(a << b) { return a << b; }); }
int shiftRight(GraphCall& c) { return binary(c, ">>", [](auto a, auto b) -> decltype(a >> b) { return a >> b; }); }
// clang-format on

int multiply(GraphCall& c) {
    const bool first = isVector(c, 1), second = isVector(c, 2);
    if (first == second) {
        return binary(c, "*", [](auto a, auto b) -> decltype(a * b) { return a * b; });
    }
    const int vector = first ? 1 : 2, factor = first ? 2 : 1;
    const Float by = c.get<Float>(factor);
    if (c.expression(vector)->kind == Kind::Vec2) return c.push(c.get<gen::Vec2>(vector) * by);
    return c.push(c.get<gen::Vec3>(vector) * by);
}

int negate(GraphCall& c) {
    const Kind kind = c.commonKind({1});
    if (kind == Kind::Int) return c.push(-c.get<Int>(1));
    if (kind == Kind::Float) return c.push(-c.get<Float>(1));
    if (kind == Kind::Vec2) return c.push(c.get<gen::Vec2>(1) * Float(-1.0f));
    if (kind == Kind::Vec3) return c.push(c.get<gen::Vec3>(1) * Float(-1.0f));
    noOperator("-", kind);
}

int floorDivide(GraphCall& c) {
    const Kind kind = c.commonKind({1, 2});
    if (kind != Kind::Int) noOperator("//", kind);
    return c.push(gen::floorDivide(c.get<Int>(1), c.get<Int>(2)));
}

int modulo(GraphCall& c) {
    const Kind kind = c.commonKind({1, 2});
    if (kind != Kind::Int) noOperator("%", kind);
    return c.push(gen::floorModulo(c.get<Int>(1), c.get<Int>(2)));
}

int power(GraphCall& c) {
    const Kind kind = c.commonKind({1, 2});
    const bool isFloat = kind == Kind::Float;
    if (!isFloat) noOperator("^", kind);
    return c.push(gen::pow(c.get<Float>(1), c.get<Float>(2)));
}

int bitAnd(GraphCall& c) {
    const Kind kind = c.commonKind({1, 2});
    if (kind == Kind::Bool) return c.push(c.get<Bool>(1) && c.get<Bool>(2));
    if (kind == Kind::Int) return c.push(c.get<Int>(1) & c.get<Int>(2));
    noOperator("&", kind);
}

int bitOr(GraphCall& c) {
    const Kind kind = c.commonKind({1, 2});
    if (kind == Kind::Bool) return c.push(c.get<Bool>(1) || c.get<Bool>(2));
    if (kind == Kind::Int) return c.push(c.get<Int>(1) | c.get<Int>(2));
    noOperator("|", kind);
}

int bitXor(GraphCall& c) {
    const Kind kind = c.commonKind({1, 2});
    if (kind == Kind::Int) return c.push(c.get<Int>(1) ^ c.get<Int>(2));
    noOperator("~", kind);
}

int bitNot(GraphCall& c) {
    const Kind kind = c.commonKind({1});
    if (kind == Kind::Bool) return c.push(!c.get<Bool>(1));
    if (kind == Kind::Int) return c.push(c.get<Int>(1) ^ Int(-1));
    noOperator("~", kind);
}

int refuseLess(GraphCall&) {
    fail("< and > do not compare expressions: write a:lt(b) or a:gt(b)");
}

int refuseLessEqual(GraphCall&) {
    fail("<= and >= do not compare expressions: write a:le(b) or a:ge(b)");
}

int refuseEqual(GraphCall&) {
    fail("== and ~= do not compare expressions: write a:eq(b) or a:ne(b)");
}

int refuseJoin(GraphCall& c) {
    fail(".. joins texts; this is {}", c.described(lua_isuserdata(c.L, 1) ? 1 : 2));
}

int refuseLength(GraphCall& c) {
    fail("# counts lists; the length of a vector is length(v); this is {}", c.described(1));
}

int refuseCall(GraphCall& c) {
    fail("{} is no function", c.described(1));
}

constexpr GraphFunction kOperators[] = {
    {"__add", add},          {"__sub", subtract},      {"__mul", multiply},     {"__div", divide},
    {"__idiv", floorDivide}, {"__mod", modulo},        {"__pow", power},        {"__unm", negate},
    {"__band", bitAnd},      {"__bor", bitOr},         {"__bxor", bitXor},      {"__bnot", bitNot},
    {"__shl", shiftLeft},    {"__shr", shiftRight},    {"__lt", refuseLess},    {"__le", refuseLessEqual},
    {"__eq", refuseEqual},   {"__concat", refuseJoin}, {"__len", refuseLength}, {"__call", refuseCall}};

constexpr GraphFunction kComparisons[] = {{"lt", less},         {"le", lessEqual}, {"gt", greater},
                                          {"ge", greaterEqual}, {"eq", equal},     {"ne", notEqual}};

}  // namespace

std::span<const GraphFunction> operators() {
    return kOperators;
}

std::span<const GraphFunction> comparisons() {
    return kComparisons;
}

}  // namespace terrane::lua
