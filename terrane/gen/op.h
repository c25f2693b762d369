// The operations of generator expressions: one record each, with all its meanings.
//
// Every operation has one possible result on every machine: integers wrap modulo 2^32; floats use only IEEE
// additions, subtractions and multiplications in a stated order (det_math.h builds the rest from them).
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string_view>

namespace terrane::gen {

// A block is an Int that holds a block id.
enum class Type : std::uint8_t { Bool, Int, Float };

// The bits of a value: floats as IEEE binary32, bools as 0 or ~0 (a lane mask).
using Bits = std::uint32_t;

constexpr Bits bitsOf(float v) {
    return std::bit_cast<Bits>(v);
}
constexpr Bits bitsOf(std::int32_t v) {
    return std::bit_cast<Bits>(v);
}
constexpr Bits bitsOf(bool v) {
    return v ? ~Bits{0} : Bits{0};
}
constexpr float asFloat(Bits b) {
    return std::bit_cast<float>(b);
}
constexpr std::int32_t asInt(Bits b) {
    return std::bit_cast<std::int32_t>(b);
}
constexpr bool asBool(Bits b) {
    return b != 0;
}

enum class Op : std::uint8_t {
    // Leaves
    Constant,  // imm: bits
    PosX,      // block coordinates of the column or voxel
    PosY,
    PosZ,
    Field,      // imm: field; of this column
    Noise,      // imm: noise call; its results are taken with Component
    BlockHere,  // block of the newest 3D pass before this one, at this voxel
    // Reads with an offset of at most 16 blocks in x and y
    FieldAt,  // (dx, dy), imm: field
    // Block of the newest 3D pass before this one in this column, (z): absolute, clamped into the world
    BlockInColumn,
    Component,  // (noise), imm: number of the result
    // Random numbers by position, imm: seed slot
    Random2D,  // (x, y) → float in [0, 1)
    Random3D,  // (x, y, z)
    // Float
    AddF,
    SubF,
    MulF,
    DivF,
    MinF,
    MaxF,
    AbsF,
    FloorF,
    SqrtF,
    LessF,
    LessEqualF,
    EqualF,
    // Int
    AddI,
    SubI,
    MulI,
    MinI,
    MaxI,
    AbsI,
    AndI,
    ShiftRightI,
    LessI,
    LessEqualI,
    EqualI,
    // Conversions
    IntToFloat,  // exact below 2^24, else rounded to nearest even
    FloatToInt,  // toward zero; the value must fit
    // Bool
    And,
    Or,
    Not,
    // Choice
    Select,  // (condition, a, b): both sides are computed
    Phi,     // (condition, a, b), imm: number of the if: sides are computed only where a lane takes them
    Count
};

struct OpRecord {
    Op op;
    std::string_view name;
    std::uint8_t argCount;
    std::array<Type, 3> argTypes;  // of Select and Phi: arguments 1 and 2 are of the result's type
    Type result;
    // The value for constant arguments; null where it is not a function of its arguments alone.
    Bits (*evaluate)(std::span<const Bits> args);
    // The same in GLSL, {0} {1} {2} standing for the arguments; empty for what glsl_emitter.cpp writes
    // itself.
    std::string_view glsl;
};

const OpRecord& record(Op op);

}  // namespace terrane::gen
