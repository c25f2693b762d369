#include "terrane/world/blocks/block_model.h"

#include <algorithm>
#include <bitset>
#include <cassert>
#include <cstdlib>
#include <glm/common.hpp>
#include <utility>

#include "terrane/world/blocks/block_type.h"

namespace terrane::world {
namespace {

// A quarter turn about the middle of the cell, from +y toward -x.
ShapeBox turned(const ShapeBox& box) {
    return {{kSixteenths - box.max.y, box.min.x, box.min.z}, {kSixteenths - box.min.y, box.max.x, box.max.z}};
}

constexpr std::array<Face, kFaceCount + 1> kTurnedFaces{kFaceNegY, kFacePosY, kFacePosX, kFaceNegX,
                                                        kFaceNegZ, kFacePosZ, kFaceCount};

ShapeQuad turned(ShapeQuad quad) {
    for (glm::ivec3& corner : quad.corners) corner = {kQuadUnits - corner.y, corner.x, corner.z};
    if (quad.hiddenBy) quad.hiddenBy = kTurnedFaces[*quad.hiddenBy];
    return quad;
}

ShapeBox upsideDown(ShapeBox box) {
    const int low = box.min.z;
    box.min.z = kSixteenths - box.max.z;
    box.max.z = kSixteenths - low;
    return box;
}

// A mirror image: corners change their order, so that the front stays in front and the lower corners below.
ShapeQuad upsideDown(ShapeQuad quad) {
    for (glm::ivec3& corner : quad.corners) corner.z = kQuadUnits - corner.z;
    std::ranges::reverse(quad.corners);
    if (quad.texels) std::ranges::reverse(*quad.texels);
    if (quad.hiddenBy && *quad.hiddenBy / 2 == 2) quad.hiddenBy = static_cast<Face>(*quad.hiddenBy ^ 1);
    return quad;
}

template <class Change>
ShapePart changed(ShapePart part, Change change) {
    for (ShapeBox& box : part.boxes) box = change(box);
    for (ShapeQuad& quad : part.quads) quad = change(quad);
    for (ShapeBox& box : part.collision) box = change(box);
    return part;
}

ShapePart turned(ShapePart part, int quarters) {
    for (int k = 0; k < quarters; ++k)
        part = changed(std::move(part), [](const auto& piece) { return turned(piece); });
    return part;
}

// Around the quads. A plane gets a sixteenth of thickness: bodies and rays need something to hit.
ShapeBox boxAround(std::span<const ShapeQuad> quads) {
    constexpr int kPart = kQuadUnits / kSixteenths;
    ShapeBox box{glm::ivec3(kSixteenths), glm::ivec3(0)};
    for (const ShapeQuad& quad : quads)
        for (const glm::ivec3& corner : quad.corners) {
            box.min = glm::min(box.min, corner / kPart);
            box.max = glm::max(box.max, (corner + kPart - 1) / kPart);
        }
    for (int axis = 0; axis < 3; ++axis) {
        box.min[axis] = std::min(box.min[axis], kSixteenths - 1);
        box.max[axis] = std::max(box.max[axis], box.min[axis] + 1);
    }
    return box;
}

ShapePart withCollision(ShapePart part) {
    if (!part.collision.empty()) return part;
    part.collision = part.boxes;
    if (!part.quads.empty()) part.collision.push_back(boxAround(part.quads));
    return part;
}

template <class T>
void append(std::vector<T>& list, const std::vector<T>& more) {
    list.insert(list.end(), more.begin(), more.end());
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
    if (!shape.other.isEmpty()) mask |= kStateOther;
    if (!shape.arm.isEmpty()) mask |= kStateArms;
    return mask;
}

ShapePart shapeAt(const ShapeDescription& shape, std::uint16_t state) {
    const bool isOther = (state & kStateOther) != 0 && !shape.other.isEmpty();
    ShapePart all = withCollision(isOther ? shape.other : shape.main);
    if (shape.hasFacing) all = turned(std::move(all), state & kStateFacing);
    // Arms are sides of the world: they do not turn with the block.
    for (int side = 0; side < 4; ++side) {
        if ((state >> (kStateArmShift + static_cast<unsigned>(side)) & 1) == 0) continue;
        const ShapePart arm = turned(withCollision(shape.arm), kTurnsToArm[static_cast<std::size_t>(side)]);
        append(all.boxes, arm.boxes);
        append(all.quads, arm.quads);
        append(all.collision, arm.collision);
    }
    if (!shape.hasHalf || (state & kStateUpsideDown) == 0) return all;
    return changed(std::move(all), [](const auto& piece) { return upsideDown(piece); });
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

namespace {

// Axes of the texture on a side of the cell: seen from outside, u runs to the right and v up; on horizontal
// faces u runs along x.
struct TextureAxes {
    int u, v;
    bool isReversedU, isReversedV;  // toward negative coordinates
};

TextureAxes axesOf(Face side) {
    const bool isLevel = side / 2 == 2;
    return {.u = side / 2 == 0 ? 1 : 0,
            .v = isLevel ? 1 : 2,
            .isReversedU = side == kFaceNegX || side == kFacePosY,
            .isReversedV = side == kFaceNegZ};
}

glm::ivec2 texelAt(const glm::ivec3& corner, const TextureAxes& axes) {
    const int u = corner[axes.u], v = corner[axes.v];
    return {axes.isReversedU ? kQuadUnits - u : u, axes.isReversedV ? v : kQuadUnits - v};
}

// The side that a normal is nearest to.
Face nearestSide(const glm::ivec3& normal) {
    int axis = 2;
    for (int other = 1; other >= 0; --other)
        if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
    return static_cast<Face>(2 * axis + (normal[axis] > 0 ? 1 : 0));
}

bool liesIn(Face side, const ShapeQuad& quad) {
    return std::ranges::all_of(quad.corners, [&](const glm::ivec3& corner) {
        return corner[side / 2] == (side % 2 == 1 ? kQuadUnits : 0);
    });
}

// The cross product: up to 2^18 by size, for steps of a cell.
glm::ivec3 crossOf(const glm::ivec3& a, const glm::ivec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

std::int64_t dotOf(const glm::ivec3& a, const glm::ivec3& b) {
    std::int64_t sum = 0;
    for (int axis = 0; axis < 3; ++axis) sum += std::int64_t{a[axis]} * b[axis];
    return sum;
}

}  // namespace

ShapeQuad quadOf(const ShapeRectangle& rectangle) {
    constexpr std::array<std::array<bool, 2>, 4> kEnds{
        {{false, false}, {true, false}, {true, true}, {false, true}}};
    const TextureAxes axes = axesOf(rectangle.side);
    ShapeQuad quad;
    for (std::size_t k = 0; k < kEnds.size(); ++k) {
        glm::ivec3& corner = quad.corners[k] = rectangle.min;
        if (kEnds[k][0] != axes.isReversedU) corner[axes.u] = rectangle.max[axes.u];
        if (kEnds[k][1] != axes.isReversedV) corner[axes.v] = rectangle.max[axes.v];
        corner *= kQuadUnits / kSixteenths;
    }
    return quad;
}

glm::ivec3 areaOf(const ShapeQuad& quad) {
    return crossOf(quad.corners[2] - quad.corners[0], quad.corners[3] - quad.corners[1]);
}

bool isConvex(const ShapeQuad& quad) {
    const glm::ivec3 area = areaOf(quad);
    if (area == glm::ivec3(0)) return false;
    for (std::size_t k = 0; k < 4; ++k) {
        const glm::ivec3 &at = quad.corners[k], &next = quad.corners[(k + 1) % 4],
                         &before = quad.corners[(k + 3) % 4];
        if (dotOf(crossOf(next - at, before - at), area) < 0) return false;
    }
    return true;
}

Face directionOf(const ShapeQuad& quad) {
    const Face side = nearestSide(areaOf(quad));
    const int axis = side / 2;
    const bool isAlongAxis = std::ranges::all_of(
        quad.corners, [&](const glm::ivec3& corner) { return corner[axis] == quad.corners[0][axis]; });
    return isAlongAxis ? side : kFaceCount;
}

ShapeQuad withDefaults(ShapeQuad quad) {
    const Face side = nearestSide(areaOf(quad));
    if (!quad.texels) {
        quad.texels.emplace();
        for (std::size_t k = 0; k < 4; ++k) (*quad.texels)[k] = texelAt(quad.corners[k], axesOf(side));
    }
    if (!quad.look) quad.look = side;
    if (!quad.hiddenBy) quad.hiddenBy = !quad.isTwoSided && liesIn(side, quad) ? side : kFaceCount;
    return quad;
}

shared::ShapeFace shapeFaceOf(const ShapeQuad& quad) {
    assert(quad.texels && "withDefaults() adds them");
    constexpr float kStep = 1.0f / kQuadUnits;
    const Face direction = directionOf(quad);
    const auto part = [&](const glm::ivec3& along, std::size_t corner, shared::uint property) {
        const glm::ivec2 texel = (*quad.texels)[corner];
        const glm::vec3 blocks = kStep * glm::vec3(along);
        return shared::vec4(blocks, shared::packFacePart(static_cast<shared::uint>(texel.x),
                                                         static_cast<shared::uint>(texel.y), property));
    };
    const auto& [lowerLeft, lowerRight, upperRight, upperLeft] = quad.corners;
    const glm::ivec3 axisU = lowerRight - lowerLeft, axisV = upperLeft - lowerLeft;
    const glm::ivec3 base = lowerLeft + glm::min(axisU, 0) + glm::min(axisV, 0);  // see shapeFaceCorner()
    return {part(base, 0, 0),
            part(axisU, 1, direction == kFaceCount ? shared::kDirectionPlant : shared::uint{direction}),
            part(axisV, 3, 0), part(upperRight - lowerLeft - axisU - axisV, 2, quad.isTwoSided ? 1 : 0)};
}

}  // namespace terrane::world
