// Text on blocks: at most four lines, stored as block entity data of blocks with the behavior `sign`. Its
// position on the block depends on shape and state. The functions have no state; any thread may call them.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/world/blocks/block_behavior.h"
#include "terrane/world/blocks/block_type.h"

namespace terrane::world {

constexpr std::size_t kSignLines = 4;
constexpr std::size_t kSignColumns = 24;  // characters a line
// A version, and lines of characters of at most 4 bytes with a line feed between: 388 bytes.
constexpr std::size_t kMaxSignBytes = 1 + kSignLines * kSignColumns * 4 + kSignLines - 1;

using SignText = std::array<std::string, kSignLines>;  // UTF-8

// Returns the characters of UTF-8; none if it is invalid, as surrogates and overlong forms are.
std::optional<std::u32string> charactersOf(std::string_view utf8);

// Returns the number of bytes of the first kSignColumns characters of a line, which may be invalid UTF-8.
std::size_t fittingBytes(std::string_view line);

// Checks a text. Returns an error if a line has too many characters, control characters or invalid UTF-8.
[[nodiscard]] base::Result<void> checkSign(const SignText& text);
// Encodes a text that checkSign() accepts.
BlockEntityData encodeSign(const SignText& text);
// Decodes any bytes; returns an error if they are no text.
[[nodiscard]] base::Result<SignText> decodeSign(const BlockEntityData& data);

// Returns the behavior `sign` of a block whose data is text.
BlockBehavior signBehavior();
bool isSign(const BlockType& type);

// The side of a sign that has the text, seen from its front, in blocks from the corner of the block's cell.
struct SignPlane {
    glm::dvec3 topLeft{0};
    glm::dvec3 right{0}, down{0};  // along the whole side
    glm::dvec3 normal{0};          // toward the reader, of length 1
};
// Returns the plane of the text, on the largest box of the block's shape; nothing if the shape has no boxes.
std::optional<SignPlane> signPlane(const BlockType& type, std::uint16_t state);

// A line of text on a plane, in blocks from its upper left corner.
struct SignLine {
    double left = 0, top = 0;
    double height = 0;  // of the text
};
// Returns the place of line `number` from 0, whose width is `aspect` times its height: in the middle, smaller
// if it would not fit.
SignLine lineOn(const SignPlane& plane, std::size_t number, double aspect);

}  // namespace terrane::world
