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

// Returns the seed of a hash as an operation's number: slot of GeneratorGraph::hashNames, and an octave that
// counts as in octaveSeedStep of noise.h.
constexpr std::uint32_t packHashSeed(std::uint32_t slot, std::uint32_t octave) {
    return octave << 24 | slot;
}
constexpr std::uint32_t hashSlot(std::uint32_t packed) {
    return packed & 0xFFFFFFu;
}
constexpr std::uint32_t hashOctave(std::uint32_t packed) {
    return packed >> 24;
}

enum class Op : std::uint8_t {
    // Leaves
    Constant,  // imm: bits
    PosX,      // block coordinates of the column or voxel
    PosY,
    PosZ,
    Field,      // imm: field; of this column
    Noise,      // imm: noise call; its results are taken with Component
    Stamp,      // block of the shapes that stand around, imm: stamp of the pass
    BlockHere,  // block of the last 3D pass before this one, at this voxel
    // Reads with an offset of at most 16 blocks in x and y
    FieldAt,  // (dx, dy), imm: field
    // Blocks of the last 3D pass before this one; z is absolute and clamped into the world
    BlockInColumn,  // (z), in this column
    BlockAt,        // (dx, dy, z)
    Stripes,        // (x, y of the direction across the stripes), imm: noise call; results as of Noise
    Component,      // (noise or stripes), imm: number of the result
    // 32 bits that depend on position and seed, imm: packHashSeed
    Hash2,  // (x, y)
    Hash3,  // (x, y, z)
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
    FloorDivideI,  // toward minus infinity; 0 for divisors below 1
    AndI,
    OrI,
    XorI,
    ShiftLeftI,
    ShiftRightI,  // arithmetic
    LessI,
    LessEqualI,
    EqualI,
    // Conversions
    IntToFloat,  // exact below 2^24, else rounded to nearest even
    FloatToInt,  // toward zero; the value must fit
    FloatBits,   // the bits of a float as an Int; every NaN gives 0x7FC00000
    BitsFloat,   // and back
    // Bool
    And,
    Or,
    Not,
    // Choice
    Select,  // (condition, a, b): both sides are computed
    Phi,     // (condition, a, b), imm: number of the if: sides are computed only where a lane takes them
    // Loops, imm: number of the loop variable (graph.h)
    LoopIn,   // (initial value): the variable at the head of each round
    LoopOut,  // (its LoopIn): the variable after the last round
    Count
};

struct OpRecord {
    Op op;
    std::string_view name;
    std::uint8_t argCount;
    std::array<Type, 3> argTypes;  // of Select and Phi: arguments 1 and 2 are of the result's type
    Type result;
    // The value for constant arguments; null if it is not a function of its arguments alone.
    Bits (*evaluate)(std::span<const Bits> args);
    // The same in GLSL, {0} {1} {2} standing for the arguments; empty for operations that glsl_emitter.cpp
    // writes itself.
    std::string_view glsl;
};

const OpRecord& record(Op op);
bool isCommutative(Op op);  // whether its two arguments can be swapped

// Returns whether the operation's imm is a noise call, and its results are taken with Component.
constexpr bool makesNoise(Op op) {
    return op == Op::Noise || op == Op::Stripes;
}

}  // namespace terrane::gen
