// The rules of block types that both back ends of the mesher follow. Pure functions; any thread.
#pragma once

#include "terrane/mesh/shape_faces.h"
#include "terrane/world/block_registry.h"

namespace terrane::mesh {

// Whether a face toward a block of the same type is left out. Where faces inside are drawn and both of a pair
// can be seen from both sides, the pair would be the same face twice: the block at the lower coordinate draws
// it.
inline bool hidesOwnKind(const world::BlockType& type, world::Face side, const world::BlockRegistry& blocks) {
    if (!type.innerFaces || type.shape == world::Shape::Liquid) return true;
    const bool isPositive = side % 2 == 1;
    return !isPositive && blocks.materials()[type.material[oppositeSide(side)]].twoSided;
}

// Where only the top of a texture waves, a face taller than one block would wave only at its top.
inline bool mergesFaces(const world::BlockType& type, world::Face side, const world::BlockRegistry& blocks) {
    return blocks.materials()[type.material[side]].animation != world::Animation::TopWaves;
}

}  // namespace terrane::mesh
