// The rules of block types that both back ends of the mesher follow. Pure functions; any thread.
#pragma once

#include "terrane/mesh/shape_faces.h"
#include "terrane/world/block_registry.h"

namespace terrane::mesh {

// Whether a face toward a block of the same type is left out. Blocks with inner faces have two at each shared
// side. If both are two-sided they look the same, so only the block at the lower coordinate has one.
inline bool hidesOwnKind(const world::BlockType& type, world::Face side, const world::BlockRegistry& blocks) {
    if (!type.innerFaces || type.shape == world::Shape::Liquid) return true;
    const bool isPositive = side % 2 == 1;
    return !isPositive && blocks.materials()[type.material[oppositeSide(side)]].twoSided;
}

// Faces whose texture waves at the top only do not merge: a face taller than one block would wave only at its
// top.
inline bool mergesFaces(const world::BlockType& type, world::Face side, const world::BlockRegistry& blocks) {
    return blocks.materials()[type.material[side]].animation != world::Animation::TopWaves;
}

}  // namespace terrane::mesh
