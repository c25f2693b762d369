// Meshes of both back ends side by side: their order within a range is each one's own.
#pragma once

#include <algorithm>

#include "terrane/mesh/region_quads.h"
#include "terrane/render/quad_store.h"

namespace terrane::mesh_gpu {

// The same quads in each range, sorted.
inline mesh::ChunkMesh sorted(mesh::ChunkMesh mesh) {
    for (const mesh::RegionMesh& region : mesh.regions) {
        for (const auto& context : region.groups) {
            for (const mesh::QuadRange range : context) {
                std::sort(mesh.quads.begin() + range.first, mesh.quads.begin() + range.first + range.count,
                          [](shared::Quad a, shared::Quad b) {
                              return std::pair(a.word0, a.word1) < std::pair(b.word0, b.word1);
                          });
            }
        }
    }
    return mesh;
}

// Read back, its regions one behind the other.
inline mesh::ChunkMesh meshIn(const render::QuadStore& store, world::ChunkPos pos) {
    mesh::ChunkMesh stored;
    for (const mesh::RegionMesh& region : store.regionsOf(pos)) {
        const std::size_t at = stored.quads.size();
        stored.quads.resize(at + mesh::quadCount(region));
        stored.regions.push_back(mesh::movedTo(static_cast<std::uint32_t>(at), region));
        store.buffer().download(std::size_t{mesh::firstQuad(region)} * shared::kQuadBytes,
                                std::as_writable_bytes(std::span(stored.quads).subspan(at)));
    }
    return stored;
}

}  // namespace terrane::mesh_gpu
