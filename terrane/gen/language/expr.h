// Typed expressions of a generator pass with C++ operators. An expression is a handle on a node of the pass's
// graph, or a literal that joins a graph once it meets an expression of one. Nothing is computed here:
// operators record.
#pragma once

#include "terrane/gen/compile/graph.h"
#include "terrane/world/chunk.h"

namespace terrane::gen {

// Base of all expressions.
struct Value {
    Graph* graph = nullptr;  // null for a literal
    Bits bits = 0;           // node, or the literal's bits

    // A value of another pass has no node in `g`: Graph::usesForeignValue().
    NodeId nodeIn(Graph& g, Type type) const {
        if (graph == nullptr) return g.constant(type, bits);
        return graph == &g ? bits : g.foreignValue(type);
    }
};

// Returns the result of an operation on values; literals alone give a literal.
Value applyOp(Op op, Type result, std::initializer_list<Value> args, std::uint32_t imm = 0);

struct Bool : Value {
    static constexpr Type kType = Type::Bool;
    Bool(bool literal) : Value{nullptr, bitsOf(literal)} {}
    explicit Bool(Value v) : Value(v) {}
};

struct Float;

struct Int : Value {
    static constexpr Type kType = Type::Int;
    Int(std::int32_t literal) : Value{nullptr, bitsOf(literal)} {}
    explicit Int(Value v) : Value(v) {}
    explicit Int(Float v);  // toward zero; the value must fit 32 bits
};

struct Float : Value {
    static constexpr Type kType = Type::Float;
    Float(float literal) : Value{nullptr, bitsOf(literal)} {}
    explicit Float(Value v) : Value(v) {}
    explicit Float(Int v) : Value(applyOp(Op::IntToFloat, kType, {v})) {}
};

inline Int::Int(Float v) : Value(applyOp(Op::FloatToInt, kType, {v})) {}

// A block id.
struct Block : Value {
    static constexpr Type kType = Type::Int;
    explicit Block(world::BlockId literal) : Value{nullptr, literal} {}
    explicit Block(Value v) : Value(v) {}
};

// clang-format off
inline Float operator+(Float a, Float b) { return Float(applyOp(Op::AddF, Type::Float, {a, b})); }
inline Float operator-(Float a, Float b) { return Float(applyOp(Op::SubF, Type::Float, {a, b})); }
inline Float operator*(Float a, Float b) { return Float(applyOp(Op::MulF, Type::Float, {a, b})); }
inline Float operator/(Float a, Float b) { return Float(applyOp(Op::DivF, Type::Float, {a, b})); }
inline Float operator-(Float a) { return Float(0.0f) - a; }
inline Bool operator<(Float a, Float b) { return Bool(applyOp(Op::LessF, Type::Bool, {a, b})); }
inline Bool operator<=(Float a, Float b) { return Bool(applyOp(Op::LessEqualF, Type::Bool, {a, b})); }
inline Bool operator>(Float a, Float b) { return b < a; }
inline Bool operator>=(Float a, Float b) { return b <= a; }

inline Int operator+(Int a, Int b) { return Int(applyOp(Op::AddI, Type::Int, {a, b})); }
inline Int operator-(Int a, Int b) { return Int(applyOp(Op::SubI, Type::Int, {a, b})); }
inline Int operator*(Int a, Int b) { return Int(applyOp(Op::MulI, Type::Int, {a, b})); }
inline Int operator&(Int a, Int b) { return Int(applyOp(Op::AndI, Type::Int, {a, b})); }
inline Int operator|(Int a, Int b) { return Int(applyOp(Op::OrI, Type::Int, {a, b})); }
inline Int operator^(Int a, Int b) { return Int(applyOp(Op::XorI, Type::Int, {a, b})); }
inline Int operator<<(Int a, Int b) { return Int(applyOp(Op::ShiftLeftI, Type::Int, {a, b})); }
inline Int operator>>(Int a, Int b) { return Int(applyOp(Op::ShiftRightI, Type::Int, {a, b})); }
inline Int operator-(Int a) { return Int(0) - a; }
inline Bool operator<(Int a, Int b) { return Bool(applyOp(Op::LessI, Type::Bool, {a, b})); }
inline Bool operator<=(Int a, Int b) { return Bool(applyOp(Op::LessEqualI, Type::Bool, {a, b})); }
inline Bool operator>(Int a, Int b) { return b < a; }
inline Bool operator>=(Int a, Int b) { return b <= a; }
inline Bool operator==(Int a, Int b) { return Bool(applyOp(Op::EqualI, Type::Bool, {a, b})); }
inline Bool operator==(Float a, Float b) { return Bool(applyOp(Op::EqualF, Type::Bool, {a, b})); }
inline Bool operator==(Block a, Block b) { return Bool(applyOp(Op::EqualI, Type::Bool, {a, b})); }

inline Bool operator!(Bool a) { return Bool(applyOp(Op::Not, Type::Bool, {a})); }
// Both sides are recorded; neither has effects, so there is nothing to short-circuit.
inline Bool operator&&(Bool a, Bool b) { return Bool(applyOp(Op::And, Type::Bool, {a, b})); }
inline Bool operator||(Bool a, Bool b) { return Bool(applyOp(Op::Or, Type::Bool, {a, b})); }
inline Bool operator!=(Int a, Int b) { return !(a == b); }
inline Bool operator!=(Float a, Float b) { return !(a == b); }
inline Bool operator!=(Block a, Block b) { return !(a == b); }

inline Float min(Float a, Float b) { return Float(applyOp(Op::MinF, Type::Float, {a, b})); }
inline Float max(Float a, Float b) { return Float(applyOp(Op::MaxF, Type::Float, {a, b})); }
inline Int min(Int a, Int b) { return Int(applyOp(Op::MinI, Type::Int, {a, b})); }
inline Int max(Int a, Int b) { return Int(applyOp(Op::MaxI, Type::Int, {a, b})); }
inline Float clamp(Float v, Float low, Float high) { return min(max(v, low), high); }
inline Int clamp(Int v, Int low, Int high) { return min(max(v, low), high); }
inline Float abs(Float a) { return Float(applyOp(Op::AbsF, Type::Float, {a})); }
inline Int abs(Int a) { return Int(applyOp(Op::AbsI, Type::Int, {a})); }
inline Float floor(Float a) { return Float(applyOp(Op::FloorF, Type::Float, {a})); }
inline Float ceil(Float a) { return -floor(-a); }
inline Float round(Float a) { return floor(a + Float(0.5f)); }  // halves upward
inline Float sqrt(Float a) { return Float(applyOp(Op::SqrtF, Type::Float, {a})); }
// These divide toward minus infinity; b is 1 or more.
inline Int floorDivide(Int a, Int b) { return Int(applyOp(Op::FloorDivideI, Type::Int, {a, b})); }
inline Int floorModulo(Int a, Int b) { return a - floorDivide(a, b) * b; }
// Returns a float's bits as a number and back; every NaN has the same ones.
inline Int floatBits(Float a) { return Int(applyOp(Op::FloatBits, Type::Int, {a})); }
inline Float bitsFloat(Int a) { return Float(applyOp(Op::BitsFloat, Type::Float, {a})); }
// clang-format on

inline Float lerp(Float a, Float b, Float t) {
    return a + t * (b - a);
}

// Returns 0 below `low`, 1 above `high`, a smooth cubic between.
inline Float smoothstep(Float low, Float high, Float v) {
    const Float t = clamp((v - low) / (high - low), 0.0f, 1.0f);
    return t * t * (Float(3.0f) - Float(2.0f) * t);
}

// Returns `a` where the condition holds, else `b`. Both sides are computed; use Pass::if_ where a side is
// costly.
template <class T>
T select(Bool condition, T a, T b) {
    return T(applyOp(Op::Select, T::kType, {condition, a, b}));
}

template <class T>
struct Case {
    Bool condition;
    T value;
};

// Returns the value of the first case whose condition holds. All values are computed.
template <class T>
T multiSelect(std::initializer_list<Case<T>> cases, T otherwise) {
    T result = otherwise;
    for (const Case<T>* c = cases.end(); c != cases.begin();) {
        --c;
        result = select(c->condition, c->value, result);
    }
    return result;
}

// Expressions of two and three numbers; operators work component by component.
struct Vec2 {
    Float x, y;
};

struct Vec3 {
    Float x, y, z;
};

struct IVec2 {
    Int x, y;
};

struct IVec3 {
    Int x, y, z;
};

// clang-format off
inline Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
inline Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
inline Vec2 operator*(Vec2 a, Float s) { return {a.x * s, a.y * s}; }
inline Vec2 operator*(Float s, Vec2 a) { return a * s; }
inline Float dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
inline Float length(Vec2 v) { return sqrt(dot(v, v)); }
inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(Vec3 a, Float s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec3 operator*(Float s, Vec3 a) { return a * s; }
inline Float dot(Vec3 a, Vec3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
inline Float length(Vec3 v) { return sqrt(dot(v, v)); }
inline IVec2 operator+(IVec2 a, IVec2 b) { return {a.x + b.x, a.y + b.y}; }
inline IVec2 operator-(IVec2 a, IVec2 b) { return {a.x - b.x, a.y - b.y}; }
inline Bool operator==(IVec2 a, IVec2 b) { return a.x == b.x && a.y == b.y; }
// clang-format on

// The functions below compute powers, logarithms and angles of expressions by additions, multiplications and
// operations on bits, so that both back ends and constant folding give the same value to the bit without code
// of their own.
//
// The polynomials are least-maximum fits on the intervals named in expr.cpp; the errors stated here are
// measured against the C library in double precision (tests/gen/expr_math_test.cpp). Returns 2^x within 1.5
// units in the last place for x in -126…128; 0 below, 2^128 less a little above.
Float exp2(Float x);
// Returns the binary logarithm within 2.5 units in the last place of the larger of the result and 1/8, for x
// ≥ 2^-126; -10^9 for smaller ones, 0 and negative numbers: exp2 returns 0 for it again.
Float log2(Float x);
// Returns x^y = exp2(y · log2(x)) for x ≥ 0, within a relative error of (2 + |y log2 x|) · 2^-23; 0 for
// negative x and y > 0, 1 for y = 0.
Float pow(Float x, Float y);
// These take radians. They are within 2^-23 for |x| ≤ 10,000; beyond, the precision decreases, equally on
// every machine.
Float sin(Float x);
Float cos(Float x);

// Returns a color as an integer: red · 2^16 + green · 2^8 + blue (world/tint.h). Each is 0…1, sRGB; others
// are clamped.
Int packColor(Float red, Float green, Float blue);

}  // namespace terrane::gen
