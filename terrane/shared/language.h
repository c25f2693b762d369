// Lets one header be read as C++20 and as GLSL 4.50. Every header in this folder includes it first.
// In both languages: `uint` is 32 bits, typed constants are `const uint kName = 4u;`, functions start with
// SHARED_FN or SHARED_INLINE, structs hold scalars, two- and four-vectors only (std430 aligns a three-vector
// to 16 bytes).
#ifndef TERRANE_SHARED_LANGUAGE_H
#define TERRANE_SHARED_LANGUAGE_H

#ifdef __cplusplus

#include <bit>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace terrane::shared {
using uint = std::uint32_t;
using glm::ivec2;
using glm::ivec4;
using glm::mat4;
using glm::uvec2;
using glm::uvec4;
using glm::vec2;
using glm::vec4;

constexpr uint floatBitsToUint(float v) {
    return std::bit_cast<uint>(v);
}
constexpr float uintBitsToFloat(uint v) {
    return std::bit_cast<float>(v);
}
}  // namespace terrane::shared

#define SHARED_FN constexpr
// Functions that call others which are no constant expressions, such as min() of vectors.
#define SHARED_INLINE inline
// Functions of hot loops: compiled for the instruction set of the caller.
#define SHARED_ALWAYS_INLINE [[gnu::always_inline]] inline
// A large parameter that is read only.
#define SHARED_REF(Type) const Type&
// A parameter that the function changes.
#define SHARED_INOUT(Type) Type&
// On float variables whose bits must be the same everywhere: no contraction, no reordering.
#define SHARED_PRECISE
#define SHARED_BEGIN namespace terrane::shared {
#define SHARED_END }

#else

#define SHARED_FN
#define SHARED_INLINE
#define SHARED_ALWAYS_INLINE
#define SHARED_REF(Type) Type
#define SHARED_INOUT(Type) inout Type
#define SHARED_PRECISE precise
#define SHARED_BEGIN
#define SHARED_END

#endif
#endif
