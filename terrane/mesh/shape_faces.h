// The table of all shape faces: where each face of each block shape lies in its cell. The mesher writes
// indices into it, the renderer uploads it once. Constant; any thread.
#pragma once

#include <span>

#include "terrane/shared/shape_face.h"
#include "terrane/world/block_type.h"

namespace terrane::mesh {

// kShapeFaceCount faces; the index is the one in a quad.
std::span<const shared::ShapeFace> shapeFaces();

// The side a face looks to, or kFaceCount where its normal is not along an axis.
world::Face shapeFaceSide(shared::uint shapeFace);

// The side that looks at `side`.
constexpr world::Face oppositeSide(world::Face side) {
    return static_cast<world::Face>(side ^ 1);
}

}  // namespace terrane::mesh
