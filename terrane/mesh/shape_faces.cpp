#include "terrane/mesh/shape_faces.h"

#include <array>
#include <cassert>

namespace terrane::mesh {
namespace {

using shared::ShapeFace;
using shared::uint;
using shared::vec4;

constexpr vec4 kPosX{1, 0, 0, 0}, kNegX{-1, 0, 0, 0};
constexpr vec4 kPosY{0, 1, 0, 0}, kNegY{0, -1, 0, 0};
constexpr vec4 kPosZ{0, 0, 1, 0}, kNegZ{0, 0, -1, 0};

constexpr float kLiquidHeight = shared::kLiquidSurfaceSixteenths / 16.0f;

// Seen from outside, u runs to the right and v up; v × 1 is a full block.
constexpr ShapeFace sideFace(world::Face side, float depth, float height = 1.0f) {
    const vec4 up{0, 0, height, 0};
    switch (side) {
        case world::kFaceNegX:
            return {{depth, 0, 0, 0}, kNegY, up, kNegX};
        case world::kFacePosX:
            return {{1 - depth, 0, 0, 0}, kPosY, up, kPosX};
        case world::kFaceNegY:
            return {{0, depth, 0, 0}, kPosX, up, kNegY};
        default:
            return {{0, 1 - depth, 0, 0}, kNegX, up, kPosY};
    }
}

constexpr ShapeFace topFace(float height) {
    return {{0, 0, height, 0}, kPosX, kPosY, kPosZ};
}
constexpr ShapeFace kBottomFace{{0, 0, 0, 0}, kPosX, kNegY, kNegZ};

// A plane of width 1 on a diagonal of the cell spans 1/√2 along x and y; centered, it starts at (1 − 1/√2)/2.
constexpr float kDiagonalSpan = 0.70710678f;
constexpr float kDiagonalStart = (1.0f - kDiagonalSpan) / 2;

constexpr ShapeFace crossFace(float signX) {
    const vec4 u{signX * kDiagonalSpan, kDiagonalSpan, 0, 0};
    const vec4 normal{kDiagonalSpan, -signX * kDiagonalSpan, 0, 0};  // u × z
    return {{kDiagonalStart, kDiagonalStart, 0, 0}, u, kPosZ, normal};
}

// Share of the surface's height; 0 for the bottom and the top of the cell.
constexpr float flowShare(uint height) {
    return height < shared::kFlowHeights ? static_cast<float>(height) / (shared::kFlowHeights - 1) : 0;
}
constexpr float flowHeight(uint height) {
    return height < shared::kFlowHeights ? kLiquidHeight * flowShare(height) : 1;
}

constexpr ShapeFace liquidTop(uint height) {
    ShapeFace face = topFace(flowHeight(height));
    face.base.w = face.axisV.w = flowShare(height);
    return face;
}

constexpr ShapeFace liquidSide(world::Face side, uint low, uint high) {
    ShapeFace face = sideFace(side, 0, flowHeight(high) - flowHeight(low));
    face.base.z = flowHeight(low);
    face.base.w = flowShare(low);
    face.axisV.w = flowShare(high);
    return face;
}

constexpr void fillFlowFaces(std::span<ShapeFace, shared::kShapeFaceCount> table) {
    constexpr uint kStill = shared::kFlowHeights - 1;
    for (uint level = 1; level < kStill; ++level)
        table[shared::kShapeFaceFlowTop + level - 1] = liquidTop(kStill - level);
    for (uint high = 1; high <= shared::kFlowHeights; ++high)
        for (uint low = 0; low < high; ++low)
            for (uint s = 0; s < 4; ++s)
                table[shared::flowSideFace(s, low, high)] =
                    liquidSide(static_cast<world::Face>(s), low, high);
}

constexpr std::array<ShapeFace, shared::kShapeFaceCount> makeTable() {
    constexpr uint kStill = shared::kFlowHeights - 1;
    std::array<ShapeFace, shared::kShapeFaceCount> table{};
    for (uint s = 0; s < 4; ++s) {
        const auto side = static_cast<world::Face>(s);
        table[shared::kShapeFaceCube + s] = sideFace(side, 0);
        table[shared::kShapeFaceHash + s] = sideFace(side, 0.25f);
        table[shared::kShapeFaceInset + s] = sideFace(side, 1.0f / 16);
        table[shared::kShapeFaceLiquidSide + s] = liquidSide(side, 0, kStill);
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

world::Face shapeFaceSide(uint shapeFace) {
    assert(shapeFace < shared::kShapeFaceCount && "index into the table");
    const vec4& normal = kTable[shapeFace].normal;
    for (int axis = 0; axis < 3; ++axis) {
        if (normal[axis] == -1.0f) return static_cast<world::Face>(2 * axis);
        if (normal[axis] == 1.0f) return static_cast<world::Face>(2 * axis + 1);
    }
    return world::kFaceCount;
}

}  // namespace terrane::mesh
