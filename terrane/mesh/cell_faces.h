// The visible faces of one block, from the block and those around it: the rules that the meshers apply to
// sets of bits (section_faces.h, mesh_gpu/), one face after the other. Rays call it for blocks that they may
// pass through; tests compare the meshers with it. Any thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "terrane/world/blocks/block_registry.h"

namespace terrane::mesh {

// Heights of liquids, as in shared/shape_face.h.
constexpr shared::uint kHeightOfStill = shared::kFlowHeights - 1, kHeightOfFull = shared::kFlowHeights;

struct CellBlock {
    world::BlockId id = world::kAir;
    std::uint16_t state = 0;
    bool isKnown = true;  // false: beyond an open border (MeshInput); `id` is what the block counts as there
};

struct CellSurroundings {
    CellBlock self;
    // By side. Below the world: world::kUnmade, since its bottom is never seen.
    std::array<CellBlock, world::kFaceCount> beside;
    std::array<CellBlock, 4> aboveBeside;  // of the upright sides; meshers do not know those in other chunks
                                           // and other sections
};

struct CellFace {
    std::uint16_t shapeFace = 0, material = 0;
    bool isTwoSided = false;
};

// Appends the faces of `around.self`.
void addCellFaces(const CellSurroundings& around, const world::BlockRegistry& blocks,
                  std::vector<CellFace>& out);

// Returns the face of one side of a cube, or none if it is hidden: for rays that meet two sides of a cube.
std::optional<CellFace> cubeFace(const CellBlock& self, const CellBlock& beside, world::Face side,
                                 const world::BlockRegistry& blocks);

}  // namespace terrane::mesh
