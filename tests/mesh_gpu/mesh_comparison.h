// Meshes of both back ends side by side: their order within a range is each one's own.
#pragma once

#include <algorithm>

#include "terrane/mesh/mesh_section_quads.h"
#include "terrane/render/quads/quad_store.h"

namespace terrane::mesh_gpu {

// The same quads in each range, sorted.
inline mesh::ChunkMesh sorted(mesh::ChunkMesh mesh) {
    for (const mesh::MeshSection& meshSection : mesh.meshSections) {
        for (const auto& bucket : meshSection.ranges) {
            for (const mesh::QuadRange range : bucket) {
                std::sort(mesh.quads.begin() + range.first, mesh.quads.begin() + range.first + range.count,
                          [](shared::Quad a, shared::Quad b) {
                              return std::pair(a.word0, a.word1) < std::pair(b.word0, b.word1);
                          });
            }
        }
    }
    return mesh;
}

// Mesh of a chunk read back from the store, its mesh sections in sequence.
inline mesh::ChunkMesh meshIn(const render::QuadStore& store, world::ChunkPos pos) {
    mesh::ChunkMesh stored;
    for (const mesh::MeshSection& meshSection : store.meshSectionsOf(pos)) {
        const std::size_t at = stored.quads.size();
        stored.quads.resize(at + mesh::quadCount(meshSection));
        stored.meshSections.push_back(mesh::movedTo(static_cast<std::uint32_t>(at), meshSection));
        const std::uint32_t first = mesh::firstQuad(meshSection);
        store.buffers().buffers[store.ranges().arenaOf(first)]->download(
            std::size_t{store.ranges().offsetOf(first)} * shared::kQuadBytes,
            std::as_writable_bytes(std::span(stored.quads).subspan(at)));
    }
    return stored;
}

}  // namespace terrane::mesh_gpu
