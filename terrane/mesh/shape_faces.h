// The table of all shape faces: where each face of each block shape lies in its cell. The mesher writes
// indices into it, the renderer uploads it once. Constant; any thread.
#pragma once

#include <span>
#include <vector>

#include "terrane/shared/shape_face.h"
#include "terrane/world/block_registry.h"

namespace terrane::mesh {

// kShapeFaceCount faces; the index is the one in a quad.
std::span<const shared::ShapeFace> shapeFaces();
// These and the faces of the blocks' models.
std::vector<shared::ShapeFace> shapeFaces(const world::BlockRegistry& blocks);

// The side a face that is none of a model looks to, or kFaceCount where its normal is not along an axis.
world::Face shapeFaceSide(shared::uint shapeFace);

// The side that looks at `side`.
constexpr world::Face oppositeSide(world::Face side) {
    return static_cast<world::Face>(side ^ 1);
}

}  // namespace terrane::mesh
