// Table of all shape faces: the place of each face of each block shape in its cell, and its part of the
// texture. The mesher writes indices into it, the renderer uploads it once. Constant; any thread.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "terrane/shared/shape_face.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::mesh {

// Returns kShapeFaceCount faces; their indices are those in quads.
std::span<const shared::ShapeFace> shapeFaces();
// Returns these faces and those of the blocks' models.
std::vector<shared::ShapeFace> shapeFaces(const world::BlockRegistry& blocks);

// Outward, of length 1.
glm::vec3 normalOf(const shared::ShapeFace& face);

// The side that a face faces, or kFaceCount if its normal is not along an axis. Not for faces of models.
world::Face shapeFaceSide(shared::uint shapeFace);

// Returns the side opposite to `side`.
constexpr world::Face oppositeSide(world::Face side) {
    return static_cast<world::Face>(side ^ 1);
}

}  // namespace terrane::mesh
