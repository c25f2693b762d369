// Shapes from content files ([[shape]]): boxes and quads in a cell, turned by the block's state.
// block_registry.h makes models of them, in which the surface of the boxes is quads too. Meshers read a
// model's faces, collision and ray casts its boxes. Plain values; any thread.
//
// These bits of the block state select a form:
//
//   0–1  facing: quarter turns of the shape in the file, counterclockwise seen from above
//   2    upside down
//   3    the other form: an open door, a torch on a wall
//   4–7  an arm toward -x, +x, -y, +y
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/image.h"
#include "terrane/base/result.h"
#include "terrane/shared/shape_face.h"
#include "terrane/world/coords.h"

namespace terrane::world {

// A source of textures of blocks: content, resource packs, tests. It returns the image of a texture by its
// name in the block types, or an error that names the missing file.
using TextureSource = std::function<base::Result<base::Image>(std::string_view)>;

// A box in the cell of a block.
struct Box {
    glm::vec3 min{0}, max{1};  // in block units inside the cell
};

// Order of faces everywhere: -x, +x, -y, +y, -z, +z.
enum Face : std::uint8_t { kFaceNegX, kFacePosX, kFaceNegY, kFacePosY, kFaceNegZ, kFacePosZ, kFaceCount };

// Returns the cell adjacent to a face of a block.
constexpr BlockPos adjacent(BlockPos pos, Face face) {
    const auto step = [&](int axis) { return face / 2 != axis ? 0 : face % 2 == 0 ? -1 : 1; };
    return offsetBy(pos, step(0), step(1), step(2));
}

constexpr std::uint16_t kStateFacing = 3, kStateUpsideDown = 4, kStateOther = 8;
constexpr unsigned kStateArmShift = 4;
constexpr std::uint16_t kStateArms = 15u << kStateArmShift;
constexpr int kSixteenths = 16;  // of a block
constexpr std::size_t kMaxShapeBoxes = 16, kMaxShapeQuads = 64;

// From 0 to kSixteenths, not empty.
struct ShapeBox {
    glm::ivec3 min{0}, max{kSixteenths};

    bool operator==(const ShapeBox&) const = default;
};

// Steps of a quad's corners in a block and of its coordinates in a texture: fractions of a sixteenth.
constexpr int kQuadUnits = shared::kTexelUnits;

// A face anywhere in the cell. Corners are those at the texture's lower left, lower right, upper right and
// upper left, as seen from the front, and enclose a convex area; two neighbors may be equal.
struct ShapeQuad {
    std::array<glm::ivec3, 4> corners{};
    bool isTwoSided = false;  // whatever the block's material says
    // The rest follows from the place of the quad if it is not given (withDefaults).
    std::optional<std::array<glm::ivec2, 4>> texels;  // of the corners, from the texture's upper left corner
    std::optional<Face> look;                         // the side of the block whose material it has
    std::optional<Face> hiddenBy;  // an opaque cube beside on this side hides it; kFaceCount: none does

    bool operator==(const ShapeQuad&) const = default;
};

// Of one form of a shape, or what an arm adds to it.
struct ShapePart {
    std::vector<ShapeBox> boxes;
    std::vector<ShapeQuad> quads;
    std::vector<ShapeBox> collision;  // empty: the boxes, and one around the quads

    bool isEmpty() const { return boxes.empty() && quads.empty(); }
};

struct ShapeDescription {
    std::string name;
    bool hasFacing = false, hasHalf = false;
    ShapePart main;   // as it is at state 0
    ShapePart other;  // the other form; empty: there is none
    ShapePart arm;    // what an arm toward +y adds; empty: there are none
    int line = 0;     // of its table in the file
};
using ShapePtr = std::shared_ptr<const ShapeDescription>;

struct ModelFace {
    std::uint16_t shapeFace = 0;  // index into the table of all shape faces
    Face look = kFacePosZ;        // the side of the block whose material it has
    Face direction = kFacePosZ;   // kFaceCount: oblique
    Face hiddenBy = kFaceCount;   // an opaque cube beside on this side hides it; kFaceCount: none does
    bool isTwoSided = false;      // whatever the material says
};

struct ModelForm {
    std::vector<ModelFace> faces;
    std::vector<Box> boxes;
    Box bounds;  // of all boxes
};

struct BlockModel {
    std::uint16_t stateMask = 0;   // bits of the state that choose a form
    std::vector<ModelForm> forms;  // stateMask + 1
    // Whether it fills at least a quarter of the cell: far tiles show it as a cube, others not at all.
    bool isBulky = false;

    const ModelForm& form(std::uint16_t state) const { return forms[state & stateMask]; }
};

struct BlockType;

// Returns the boxes that stop bodies, and those that rays from the camera hit, in a state of the block.
std::span<const Box> collisionBoxes(const BlockType& type, std::uint16_t state);
std::span<const Box> selectionBoxes(const BlockType& type, std::uint16_t state);
// Returns the bounds of the selection boxes.
Box selectionBounds(const BlockType& type, std::uint16_t state);

// Returns the bits of the state that select a form.
std::uint16_t formMask(const ShapeDescription& shape);
// The boxes and quads of a state, with facing, form, arms and half applied; collision is not empty.
ShapePart shapeAt(const ShapeDescription& shape, std::uint16_t state);

constexpr std::size_t kCellParts = kSixteenths * kSixteenths * kSixteenths;
std::size_t filledParts(std::span<const ShapeBox> boxes);  // of kCellParts

// A rectangle of a surface, on the plane where min and max are equal.
struct ShapeRectangle {
    Face side = kFacePosZ;
    glm::ivec3 min{0}, max{0};

    bool operator==(const ShapeRectangle&) const = default;
};

// Returns the outer surface of boxes that may touch and overlap, each part of it once.
std::vector<ShapeRectangle> surfaceOf(std::span<const ShapeBox> boxes);

// The face of a box as a quad that shows the part of its texture at its place in the cell.
ShapeQuad quadOf(const ShapeRectangle& rectangle);

// Twice the area of a quad as a vector along its outward normal, in steps.
glm::ivec3 areaOf(const ShapeQuad& quad);
bool isConvex(const ShapeQuad& quad);
// The side that a quad faces, or kFaceCount if its normal is not along an axis.
Face directionOf(const ShapeQuad& quad);
// With everything that follows from its place. The texture is projected onto the side that the quad faces
// most, whose material it has. An opaque cube beside hides a one-sided quad that lies in the side that it
// faces.
ShapeQuad withDefaults(ShapeQuad quad);
// `quad` has texels.
shared::ShapeFace shapeFaceOf(const ShapeQuad& quad);

}  // namespace terrane::world
