// The block types in the form that the meshing shaders read: rules of visibility and merging as bits,
// materials with their draw buckets. It uses no OpenGL.
#pragma once

#include <vector>

#include "terrane/shared/mesher.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::mesh_gpu {

struct BlockTable {
    explicit BlockTable(const world::BlockRegistry& blocks);

    const shared::MeshType& type(world::BlockId id) const {
        return types[id < types.size() ? id : types.size() - 1];
    }

    std::vector<shared::MeshType> types;  // by id; the last stands for all ids from there on
    std::vector<shared::uint> forms;      // see MeshType; never empty: OpenGL has no empty buffers
};

}  // namespace terrane::mesh_gpu
