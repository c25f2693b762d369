#include "terrane/mesh/shape_faces.h"

#include <array>
#include <cassert>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace terrane::mesh {
namespace {

using shared::ShapeFace;
using shared::uint;
using shared::vec4;

constexpr vec4 kPosX{1, 0, 0, 0}, kNegX{-1, 0, 0, 0};
constexpr vec4 kPosY{0, 1, 0, 0}, kNegY{0, -1, 0, 0};
constexpr vec4 kPosZ{0, 0, 1, 0};

constexpr float kLiquidHeight = shared::kLiquidSurfaceSixteenths / 16.0f;

// Shows the whole texture.
constexpr ShapeFace wholeFace(vec4 base, vec4 axisU, vec4 axisV, uint direction) {
    base.w = shared::packFacePart(0, shared::kTexelUnits, 0);
    axisU.w = shared::packFacePart(shared::kTexelUnits, shared::kTexelUnits, direction);
    axisV.w = shared::packFacePart(0, 0, 0);
    return {base, axisU, axisV, shared::flatBend()};
}

// Seen from outside, u runs to the right and v up; v × 1 is a full block.
constexpr ShapeFace sideFace(uint side, uint direction, float depth, float height = 1.0f) {
    const vec4 up{0, 0, height, 0};
    switch (side) {
        case world::kFaceNegX:
            return wholeFace({depth, 0, 0, 0}, kNegY, up, direction);
        case world::kFacePosX:
            return wholeFace({1 - depth, 0, 0, 0}, kPosY, up, direction);
        case world::kFaceNegY:
            return wholeFace({0, depth, 0, 0}, kPosX, up, direction);
        default:
            return wholeFace({0, 1 - depth, 0, 0}, kNegX, up, direction);
    }
}

constexpr ShapeFace topFace(float height) {
    return wholeFace({0, 0, height, 0}, kPosX, kPosY, world::kFacePosZ);
}
constexpr ShapeFace kBottomFace = wholeFace({0, 0, 0, 0}, kPosX, kNegY, world::kFaceNegZ);

// A plane of width 1 on a diagonal of the cell spans 1/√2 along x and y; centered, it starts at (1 − 1/√2)/2.
constexpr float kDiagonalSpan = 0.70710678f;
constexpr float kDiagonalStart = (1.0f - kDiagonalSpan) / 2;

constexpr ShapeFace crossFace(float signX) {
    const vec4 u{signX * kDiagonalSpan, kDiagonalSpan, 0, 0};
    return wholeFace({kDiagonalStart, kDiagonalStart, 0, 0}, u, kPosZ, shared::kDirectionPlant);
}

// In eighths of the surface's height; 0 for the bottom and the top of the cell.
constexpr uint flowShare(uint height) {
    return height < shared::kFlowHeights ? height : 0;
}
constexpr float flowHeight(uint height) {
    constexpr float kShares = shared::kFlowHeights - 1;
    return height < shared::kFlowHeights ? kLiquidHeight * (static_cast<float>(height) / kShares) : 1;
}

constexpr void setShares(ShapeFace& face, uint low, uint high) {
    face.base.w = shared::packFacePart(0, shared::kTexelUnits, flowShare(low));
    face.axisV.w = shared::packFacePart(0, 0, flowShare(high));
}

constexpr ShapeFace liquidTop(uint height) {
    ShapeFace face = topFace(flowHeight(height));
    setShares(face, height, height);
    return face;
}

constexpr ShapeFace liquidSide(uint side, uint low, uint high) {
    ShapeFace face = sideFace(side, side, 0, flowHeight(high) - flowHeight(low));
    face.base.z = flowHeight(low);
    setShares(face, low, high);
    return face;
}

// Distance from the texture's upper edge at a height in the cell: for the surface's default height, which is
// a whole number of steps. The vertex shader knows the liquid's own height.
constexpr uint flowTexel(uint height) {
    constexpr uint kSteps = shared::kTexelUnits * shared::kLiquidSurfaceSixteenths / 16;
    static_assert(kSteps % (shared::kFlowHeights - 1) == 0, "a step for each height");
    return height < shared::kFlowHeights ? shared::kTexelUnits - kSteps / (shared::kFlowHeights - 1) * height
                                         : 0;
}

// The side of a flowing liquid shows the part of the texture at its place in the cell.
constexpr ShapeFace flowSide(uint side, uint low, uint high) {
    ShapeFace face = liquidSide(side, low, high);
    const uint lowTexel = flowTexel(low), highTexel = flowTexel(high), width = shared::kTexelUnits;
    face.base.w = shared::packFacePart(0, lowTexel, flowShare(low));
    face.axisU.w = shared::packFacePart(width, lowTexel, side);
    face.axisV.w = shared::packFacePart(0, highTexel, flowShare(high));
    face.bend.w = shared::packFacePart(width, highTexel, 0);
    return face;
}

constexpr void fillFlowFaces(std::span<ShapeFace, shared::kShapeFaceCount> table) {
    constexpr uint kStill = shared::kFlowHeights - 1;
    for (uint level = 1; level < kStill; ++level)
        table[shared::kShapeFaceFlowTop + level - 1] = liquidTop(kStill - level);
    for (uint high = 1; high <= shared::kFlowHeights; ++high)
        for (uint low = 0; low < high; ++low)
            for (uint s = 0; s < 4; ++s) table[shared::flowSideFace(s, low, high)] = flowSide(s, low, high);
}

constexpr std::array<ShapeFace, shared::kShapeFaceCount> makeTable() {
    constexpr uint kStill = shared::kFlowHeights - 1;
    std::array<ShapeFace, shared::kShapeFaceCount> table{};
    for (uint s = 0; s < 4; ++s) {
        table[shared::kShapeFaceCube + s] = sideFace(s, s, 0);
        table[shared::kShapeFaceHash + s] = sideFace(s, shared::kDirectionPlant, 0.25f);
        table[shared::kShapeFaceInset + s] = sideFace(s, s, 1.0f / 16);
        table[shared::kShapeFaceLiquidSide + s] = liquidSide(s, 0, kStill);
    }
    table[shared::kShapeFaceCube + world::kFaceNegZ] = kBottomFace;
    table[shared::kShapeFaceCube + world::kFacePosZ] = topFace(1);
    table[shared::kShapeFaceCross] = crossFace(1);
    table[shared::kShapeFaceCross + 1] = crossFace(-1);
    table[shared::kShapeFaceLiquidTop] = liquidTop(kStill);
    fillFlowFaces(table);
    return table;
}

constexpr std::array<ShapeFace, shared::kShapeFaceCount> kTable = makeTable();

}  // namespace

std::span<const ShapeFace> shapeFaces() {
    return kTable;
}

std::vector<ShapeFace> shapeFaces(const world::BlockRegistry& blocks) {
    std::vector<ShapeFace> table(kTable.begin(), kTable.end());
    table.insert(table.end(), blocks.modelFaces().begin(), blocks.modelFaces().end());
    return table;
}

glm::vec3 normalOf(const ShapeFace& face) {
    const glm::vec3 normal = glm::cross(glm::vec3(face.axisU + face.axisV + face.bend),
                                        glm::vec3(face.axisV - face.axisU));  // of the diagonals
    // Rounding must not tilt a face along an axis.
    glm::vec3 alongAxis(0);
    for (int axis = 0; axis < 3; ++axis) alongAxis[axis] = glm::sign(normal[axis]);
    return glm::dot(alongAxis, alongAxis) == 1 ? alongAxis : glm::normalize(normal);
}

world::Face shapeFaceSide(uint shapeFace) {
    assert(shapeFace < shared::kShapeFaceCount && "index into the table");
    const glm::vec3 normal = normalOf(kTable[shapeFace]);
    for (int axis = 0; axis < 3; ++axis) {
        if (normal[axis] == -1.0f) return static_cast<world::Face>(2 * axis);
        if (normal[axis] == 1.0f) return static_cast<world::Face>(2 * axis + 1);
    }
    return world::kFaceCount;
}

}  // namespace terrane::mesh
