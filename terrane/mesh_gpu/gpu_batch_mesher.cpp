#include "terrane/mesh_gpu/gpu_batch_mesher.h"

#include <algorithm>

#include "terrane/mesh/mesh_section_quads.h"

namespace terrane::mesh_gpu {
std::vector<mesh::ChunkMesh> GpuBatchMesher::mesh(std::span<const mesh::MeshInput> chunks) {
    std::vector<mesh::ChunkMesh> meshes;
    meshes.reserve(chunks.size());
    while (!chunks.empty()) {
        const std::size_t count = std::min(chunks.size(), GpuMesher::kMaxChunks);
        meshPart(chunks.first(count), meshes);
        chunks = chunks.subspan(count);
    }
    return meshes;
}

void GpuBatchMesher::meshPart(std::span<const mesh::MeshInput> chunks, std::vector<mesh::ChunkMesh>& meshes) {
    mesher_.count(chunks);
    const std::vector<mesh::MeshSection> meshSections = mesher_.meshSections();
    std::vector<std::uint32_t> firstQuads;
    std::uint32_t total = 0;
    for (const mesh::MeshSection& meshSection : meshSections) {
        firstQuads.push_back(total);
        total += mesh::quadCount(meshSection);
    }
    std::vector<shared::Quad> quads(total);
    if (total > 0) {
        const std::size_t bytes = std::size_t{total} * shared::kQuadBytes;
        if (quads_.sizeBytes() < bytes) quads_ = gpu::Buffer(bytes, 0, "mesh result");
        mesher_.write(firstQuads, quads_);
        quads_.download(0, std::as_writable_bytes(std::span(quads)));
    }
    const std::size_t meshSectionsPerChunk = meshSections.size() / chunks.size();
    auto from = quads.begin();
    for (std::size_t k = 0; k < meshSections.size(); k += meshSectionsPerChunk) {
        mesh::ChunkMesh& chunk = meshes.emplace_back();
        std::uint32_t first = 0;
        for (std::size_t r = k; r < k + meshSectionsPerChunk; ++r) {
            chunk.meshSections.push_back(mesh::movedTo(first, meshSections[r]));
            first += mesh::quadCount(meshSections[r]);
        }
        chunk.quads.assign(from, from + first);
        from += first;
    }
}

}  // namespace terrane::mesh_gpu
