// Functions of expressions. Where all arguments are literals the result is a number of Lua, computed as
// expressions are.
#include <algorithm>

#include "terrane/gen/generators/trees/trees.h"
#include "terrane/gen/noise/noise.h"
#include "terrane/lua/graph_call_internal.h"

namespace terrane::lua {
namespace {

using gen::Bool;
using gen::Float;
using gen::Int;

constexpr int kMaxCases = 1'000;

// Calls it with Int or Float, whichever the arguments are.
template <class Use>
int withNumbers(GraphCall& c, std::initializer_list<int> arguments, Use use) {
    const Kind kind = c.commonKind(arguments);
    if (kind == Kind::Int) return use(Int(0));
    if (kind == Kind::Float) return use(Float(0.0f));
    fail("{}: expected Int or Float, got {}", c.function, nameOf(kind));
}

Parts selectParts(Bool condition, Kind kind, const Parts& a, const Parts& b) {
    Parts result;
    for (std::size_t k = 0; k < partCount(kind); ++k)
        result[k] = gen::applyOp(gen::Op::Select, typeOf(kind), {condition, a[k], b[k]});
    return result;
}

int select(GraphCall& c) {
    const Kind kind = c.commonKind({2, 3});
    // One after the other: names of blocks are numbered as they come, on every machine alike.
    const Bool condition = c.get<Bool>(1);
    const Parts a = c.parts(2, kind), b = c.parts(3, kind);
    return c.push(kind, selectParts(condition, kind, a, b));
}

// Pushes a case's condition and value.
void pushCase(GraphCall& c, int cases, int number) {
    if (lua_geti(c.L, cases, number) != LUA_TTABLE)
        fail("multiSelect: case {} is not {{condition, value}}", number);
    lua_geti(c.L, -1, 1);
    lua_geti(c.L, -2, 2);
    lua_remove(c.L, -3);
}

// The kind that all values share. A literal takes the kind of the others.
Kind kindOfCases(GraphCall& c, int count) {
    Kind common = c.commonKind({2});
    bool isFixed = c.expression(2) != nullptr || !c.isNumber(2);
    for (int k = 1; k <= count; ++k) {
        pushCase(c, 1, k);
        const int value = lua_gettop(c.L);
        const Kind kind = c.commonKind({value});
        const bool isNumber = c.isNumber(value);
        if (!isNumber && isFixed && kind != common)
            fail("multiSelect: case {}: {} and {} do not match", k, nameOf(common), nameOf(kind));
        if (!isNumber || (!isFixed && kind == Kind::Float)) common = kind;
        isFixed = isFixed || !isNumber;
        lua_pop(c.L, 2);
    }
    return common;
}

int multiSelect(GraphCall& c) {
    const auto count = static_cast<int>(std::min<lua_Integer>(c.listLength(1), kMaxCases + 1));
    if (count > kMaxCases) fail("multiSelect: more than {} cases", kMaxCases);
    c.charge(10 * count);
    if (lua_isnone(c.L, 2)) c.expected(2, "the value where no case holds");
    const Kind kind = kindOfCases(c, count);
    Parts result = c.parts(2, kind);
    for (int k = count; k >= 1; --k) {
        pushCase(c, 1, k);
        const int condition = lua_gettop(c.L) - 1;
        result = selectParts(c.get<Bool>(condition), kind, c.parts(condition + 1, kind), result);
        lua_pop(c.L, 2);
    }
    return c.push(kind, result);
}

// Applies the operation to two or more arguments, from left to right.
template <class Operation>
int fold(GraphCall& c, Operation operation) {
    const int count = c.count();
    c.charge(40 * count);
    for (int k = 2; k <= count || k == 2; ++k) {
        const auto step = [&](auto t) {
            using T = decltype(t);
            return c.push(operation(c.get<T>(1), c.get<T>(k)));
        };
        withNumbers(c, {1, k}, step);
        lua_replace(c.L, 1);
    }
    lua_pushvalue(c.L, 1);
    return 1;
}

int minimum(GraphCall& c) {
    return fold(c, [](auto a, auto b) { return gen::min(a, b); });
}

int maximum(GraphCall& c) {
    return fold(c, [](auto a, auto b) { return gen::max(a, b); });
}

// clang-format off
int clamp(GraphCall& c) { return withNumbers(c, {1, 2, 3}, [&](auto t) { using T = decltype(t); return c.push(gen::clamp(c.get<T>(1), c.get<T>(2), c.get<T>(3))); }); }
int absolute(GraphCall& c) { return withNumbers(c, {1}, [&](auto t) { using T = decltype(t); return c.push(gen::abs(c.get<T>(1))); }); }
int floor(GraphCall& c) { return c.push(gen::floor(c.get<Float>(1))); }
int ceil(GraphCall& c) { return c.push(gen::ceil(c.get<Float>(1))); }
int round(GraphCall& c) { return c.push(gen::round(c.get<Float>(1))); }
int squareRoot(GraphCall& c) { return c.push(gen::sqrt(c.get<Float>(1))); }
int exp2(GraphCall& c) { return c.push(gen::exp2(c.get<Float>(1))); }
int log2(GraphCall& c) { return c.push(gen::log2(c.get<Float>(1))); }
int powerOf(GraphCall& c) { return c.push(gen::pow(c.get<Float>(1), c.get<Float>(2))); }
int sine(GraphCall& c) { return c.push(gen::sin(c.get<Float>(1))); }
int cosine(GraphCall& c) { return c.push(gen::cos(c.get<Float>(1))); }
int lerp(GraphCall& c) { return c.push(gen::lerp(c.get<Float>(1), c.get<Float>(2), c.get<Float>(3))); }
int smoothstep(GraphCall& c) { return c.push(gen::smoothstep(c.get<Float>(1), c.get<Float>(2), c.get<Float>(3))); }
int floorDivision(GraphCall& c) { return c.push(gen::floorDivide(c.get<Int>(1), c.get<Int>(2))); }
int floorModulo(GraphCall& c) { return c.push(gen::floorModulo(c.get<Int>(1), c.get<Int>(2))); }
int packColor(GraphCall& c) { return c.push(gen::packColor(c.get<Float>(1), c.get<Float>(2), c.get<Float>(3))); }
int floatBits(GraphCall& c) { return c.push(gen::floatBits(c.get<Float>(1))); }
int bitsFloat(GraphCall& c) { return c.push(gen::bitsFloat(c.get<Int>(1))); }
int toInt(GraphCall& c) { return c.commonKind({1}) == Kind::Int ? c.push(c.get<Int>(1)) : c.push(Int(c.get<Float>(1))); }
int toFloat(GraphCall& c) { return c.commonKind({1}) == Kind::Float ? c.push(c.get<Float>(1)) : c.push(Float(c.get<Int>(1))); }
int vec2(GraphCall& c) { return c.push(gen::Vec2{c.get<Float>(1), c.get<Float>(2)}); }
int vec3(GraphCall& c) { return c.push(gen::Vec3{c.get<Float>(1), c.get<Float>(2), c.get<Float>(3)}); }
int ivec2(GraphCall& c) { return c.push(gen::IVec2{c.get<Int>(1), c.get<Int>(2)}); }
// clang-format on

int dot(GraphCall& c) {
    if (c.commonKind({1, 2}) == Kind::Vec3) return c.push(gen::dot(c.get<gen::Vec3>(1), c.get<gen::Vec3>(2)));
    return c.push(gen::dot(c.get<gen::Vec2>(1), c.get<gen::Vec2>(2)));
}

int length(GraphCall& c) {
    if (c.commonKind({1}) == Kind::Vec3) return c.push(gen::length(c.get<gen::Vec3>(1)));
    return c.push(gen::length(c.get<gen::Vec2>(1)));
}

int lostDeviation(GraphCall& c) {
    return c.push(Float(gen::lostDeviation(c.weights(1), c.size(2), c.integer(3, 1, 1 << world::kMaxLevel))));
}

int lostSlope(GraphCall& c) {
    return c.push(Float(gen::lostSlope(c.weights(1), c.size(2), c.integer(3, 1, 1 << world::kMaxLevel))));
}

int shareLeft(GraphCall& c) {
    return c.push(Float(gen::shareLeft(c.size(1), c.integer(2, 1, 1 << world::kMaxLevel))));
}

int shapeOf(GraphCall& c) {
    c.table(1);
    gen::trees::KindRecord kind;
    lua_getfield(c.L, 1, "first");
    kind.first = c.integer(lua_gettop(c.L), 0, gen::kMaxShapes);
    lua_getfield(c.L, 1, "count");
    kind.count = c.integer(lua_gettop(c.L), 1, gen::kMaxShapes);
    return c.push(gen::trees::shapeOf(kind, c.get<Int>(2)));
}

constexpr GraphFunction kExpressionFunctions[] = {{"select", select},
                                                  {"multiSelect", multiSelect},
                                                  {"min", minimum},
                                                  {"max", maximum},
                                                  {"clamp", clamp},
                                                  {"abs", absolute},
                                                  {"floor", floor},
                                                  {"ceil", ceil},
                                                  {"round", round},
                                                  {"sqrt", squareRoot},
                                                  {"exp2", exp2},
                                                  {"log2", log2},
                                                  {"pow", powerOf},
                                                  {"sin", sine},
                                                  {"cos", cosine},
                                                  {"lerp", lerp},
                                                  {"smoothstep", smoothstep},
                                                  {"floorDivide", floorDivision},
                                                  {"floorModulo", floorModulo},
                                                  {"packColor", packColor},
                                                  {"floatBits", floatBits},
                                                  {"bitsFloat", bitsFloat},
                                                  {"int", toInt},
                                                  {"float", toFloat},
                                                  {"vec2", vec2},
                                                  {"vec3", vec3},
                                                  {"ivec2", ivec2},
                                                  {"dot", dot},
                                                  {"length", length},
                                                  {"lostDeviation", lostDeviation},
                                                  {"lostSlope", lostSlope},
                                                  {"shareLeft", shareLeft},
                                                  {"shapeOf", shapeOf}};

}  // namespace

std::span<const GraphFunction> expressionFunctions() {
    return kExpressionFunctions;
}

}  // namespace terrane::lua
