// Table of all shape faces: the place of each face of each block shape in its cell. The mesher writes indices
// into it, the renderer uploads it once. Constant; any thread.
#pragma once

#include <span>
#include <vector>

#include "terrane/shared/shape_face.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::mesh {

// kShapeFaceCount faces; the index is the one in a quad.
std::span<const shared::ShapeFace> shapeFaces();
// These and the faces of the blocks' models.
std::vector<shared::ShapeFace> shapeFaces(const world::BlockRegistry& blocks);

// The side that a face faces, or kFaceCount if its normal is not along an axis. Not for faces of models.
world::Face shapeFaceSide(shared::uint shapeFace);

// The side opposite to `side`.
constexpr world::Face oppositeSide(world::Face side) {
    return static_cast<world::Face>(side ^ 1);
}

}  // namespace terrane::mesh
