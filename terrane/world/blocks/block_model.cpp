#include "terrane/world/blocks/block_model.h"

#include <algorithm>
#include <bitset>
#include <cassert>

#include "terrane/world/blocks/block_type.h"

namespace terrane::world {
namespace {

// A quarter turn about the middle of the cell, from +y toward -x.
ShapeBox turned(const ShapeBox& box) {
    return {{kSixteenths - box.max.y, box.min.x, box.min.z}, {kSixteenths - box.min.y, box.max.x, box.max.z}};
}

ShapeBox turned(ShapeBox box, int quarters) {
    for (int k = 0; k < quarters; ++k) box = turned(box);
    return box;
}

ShapeBox upsideDown(ShapeBox box) {
    const int low = box.min.z;
    box.min.z = kSixteenths - box.max.z;
    box.max.z = kSixteenths - low;
    return box;
}

// Quarter turns from +y to each of the four sides, in the order of Face.
constexpr std::array<int, 4> kTurnsToArm{1, 3, 2, 0};

// The filled parts of the cell's 16³.
using Volume = std::bitset<kCellParts>;

bool isFilled(const Volume& volume, glm::ivec3 at) {
    for (int axis = 0; axis < 3; ++axis)
        if (at[axis] < 0 || at[axis] >= kSixteenths) return false;
    return volume[static_cast<std::size_t>(at.x + kSixteenths * (at.y + kSixteenths * at.z))];
}

Volume volumeOf(std::span<const ShapeBox> boxes) {
    Volume volume;
    for (const ShapeBox& box : boxes)
        for (int z = box.min.z; z < box.max.z; ++z)
            for (int y = box.min.y; y < box.max.y; ++y)
                for (int x = box.min.x; x < box.max.x; ++x)
                    volume.set(static_cast<std::size_t>(x + kSixteenths * (y + kSixteenths * z)));
    return volume;
}

// The visible parts of one plane of a side, and their merging into rectangles.
class Plane {
  public:
    Plane(const Volume& volume, Face side, int layer) : side_(side), layer_(layer) {
        glm::ivec3 outward(0);
        outward[axis()] = side % 2 == 1 ? 1 : -1;
        for (int v = 0; v < kSixteenths; ++v)
            for (int u = 0; u < kSixteenths; ++u) {
                const glm::ivec3 at = cell(u, v);
                if (isFilled(volume, at) && !isFilled(volume, at + outward)) seen_.set(index(u, v));
            }
    }

    // Grows each rectangle along u first, then along v.
    void mergeInto(std::vector<ShapeRectangle>& rectangles) {
        for (int v = 0; v < kSixteenths; ++v)
            for (int u = 0; u < kSixteenths; ++u) {
                if (!seen_[index(u, v)]) continue;
                int endU = u + 1, endV = v + 1;
                while (endU < kSixteenths && seen_[index(endU, v)]) ++endU;
                while (endV < kSixteenths && isRowSeen(u, endU, endV)) ++endV;
                for (int row = v; row < endV; ++row)
                    for (int at = u; at < endU; ++at) seen_.reset(index(at, row));
                rectangles.push_back(rectangle({u, v}, {endU, endV}));
            }
    }

  private:
    int axis() const { return side_ / 2; }
    static std::size_t index(int u, int v) { return static_cast<std::size_t>(u + kSixteenths * v); }
    glm::ivec3 cell(int u, int v) const {
        glm::ivec3 at;
        at[axis()] = layer_;
        at[(axis() + 1) % 3] = u;
        at[(axis() + 2) % 3] = v;
        return at;
    }
    bool isRowSeen(int u, int endU, int v) const {
        for (int at = u; at < endU; ++at)
            if (!seen_[index(at, v)]) return false;
        return true;
    }
    ShapeRectangle rectangle(std::array<int, 2> begin, std::array<int, 2> end) const {
        ShapeRectangle result{side_, cell(begin[0], begin[1]), cell(end[0], end[1])};
        const int at = side_ % 2 == 1 ? layer_ + 1 : layer_;
        result.min[axis()] = result.max[axis()] = at;
        return result;
    }

    Face side_;
    int layer_;
    std::bitset<kSixteenths * kSixteenths> seen_;
};

}  // namespace

std::span<const Box> collisionBoxes(const BlockType& type, std::uint16_t state) {
    const bool hasModel = type.model && !type.collision.empty();
    return hasModel ? std::span<const Box>(type.model->form(state).boxes) : type.collision;
}

std::span<const Box> selectionBoxes(const BlockType& type, std::uint16_t state) {
    return type.model ? std::span<const Box>(type.model->form(state).boxes) : std::span(&type.selection, 1);
}

Box selectionBounds(const BlockType& type, std::uint16_t state) {
    return type.model ? type.model->form(state).bounds : type.selection;
}

std::uint16_t formMask(const ShapeDescription& shape) {
    std::uint16_t mask = 0;
    if (shape.hasFacing) mask |= kStateFacing;
    if (shape.hasHalf) mask |= kStateUpsideDown;
    if (!shape.other.empty()) mask |= kStateOther;
    if (!shape.arms.empty()) mask |= kStateArms;
    return mask;
}

std::vector<ShapeBox> boxesOf(const ShapeDescription& shape, std::uint16_t state) {
    const bool isOther = (state & kStateOther) != 0 && !shape.other.empty();
    std::vector<ShapeBox> boxes = isOther ? shape.other : shape.boxes;
    if (shape.hasFacing)
        for (ShapeBox& box : boxes) box = turned(box, state & kStateFacing);
    // Arms are sides of the world: they do not turn with the block.
    for (int side = 0; side < 4; ++side) {
        if ((state >> (kStateArmShift + static_cast<unsigned>(side)) & 1) == 0) continue;
        for (const ShapeBox& arm : shape.arms)
            boxes.push_back(turned(arm, kTurnsToArm[static_cast<std::size_t>(side)]));
    }
    if (shape.hasHalf && (state & kStateUpsideDown) != 0)
        for (ShapeBox& box : boxes) box = upsideDown(box);
    return boxes;
}

std::size_t filledParts(std::span<const ShapeBox> boxes) {
    return volumeOf(boxes).count();
}

std::vector<ShapeRectangle> surfaceOf(std::span<const ShapeBox> boxes) {
    const Volume volume = volumeOf(boxes);
    std::vector<ShapeRectangle> rectangles;
    for (int side = 0; side < kFaceCount; ++side)
        for (int layer = 0; layer < kSixteenths; ++layer)
            Plane(volume, static_cast<Face>(side), layer).mergeInto(rectangles);
    return rectangles;
}

// Seen from outside, u runs to the right and v up; on horizontal faces u runs along x.
shared::ShapeFace shapeFaceOf(const ShapeRectangle& rectangle) {
    constexpr float kPart = 1.0f / kSixteenths;
    const glm::vec3 base = kPart * glm::vec3(rectangle.min);
    const glm::vec3 size = kPart * glm::vec3(rectangle.max - rectangle.min);
    shared::ShapeFace face{{base.x, base.y, base.z, 0}, {}, {}, {}};
    face.normal[rectangle.side / 2] = rectangle.side % 2 == 1 ? 1.0f : -1.0f;
    const bool isAlongX = rectangle.side / 2 == 0, isLevel = rectangle.side / 2 == 2;
    const bool isReversed = rectangle.side == kFaceNegX || rectangle.side == kFacePosY;
    const int axisU = isAlongX ? 1 : 0, axisV = isLevel ? 1 : 2;
    face.axisU[axisU] = isReversed ? -size[axisU] : size[axisU];
    face.axisV[axisV] = rectangle.side == kFaceNegZ ? -size[axisV] : size[axisV];
    return face;
}

}  // namespace terrane::world
