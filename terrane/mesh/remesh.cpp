#include "terrane/mesh/remesh.h"

#include <cstddef>

#include "terrane/base/result.h"
#include "terrane/mesh/mesh_section_quads.h"

namespace terrane::mesh {
namespace {

MeshSectionSet meshSectionAt(int z, int meshSectionHeight) {
    return world::isInHeight(z) ? MeshSectionSet{1} << (z / meshSectionHeight) : MeshSectionSet{0};
}

}  // namespace

std::vector<TouchedChunk> meshSectionsTouchedBy(world::BlockPos pos, int meshSectionHeight) {
    base::require(world::isInHeight(pos.z), "meshSectionsTouchedBy: the block is above or below the world");
    base::require(isMeshSectionHeight(meshSectionHeight),
                  "meshSectionsTouchedBy: the height of mesh sections is a power of two, 8 to 128");
    const MeshSectionSet own = meshSectionAt(pos.z, meshSectionHeight);
    const world::ChunkPos chunk = world::chunkOf(pos);
    std::vector<TouchedChunk> touched{{chunk, own | meshSectionAt(pos.z - 1, meshSectionHeight) |
                                                  meshSectionAt(pos.z + 1, meshSectionHeight)}};
    const auto addBeside = [&](int dx, int dy) {
        const world::ChunkPos beside = world::offsetBy(chunk, dx, dy);
        if (world::isInWorld(beside)) touched.push_back({beside, own});
    };
    const int x = pos.x & 15, y = pos.y & 15;
    if (x == 0) addBeside(-1, 0);
    if (x == 15) addBeside(1, 0);
    if (y == 0) addBeside(0, -1);
    if (y == 15) addBeside(0, 1);
    return touched;
}

ChunkMesh buildMeshSections(const MeshInput& input, MeshSectionSet meshSections, MeshScratch& scratch) {
    if (meshSections == kAllMeshSections) return meshChunk(input, scratch);
    ChunkMesh mesh;
    const auto count = static_cast<std::size_t>(world::kChunkHeight / input.options.meshSectionHeight);
    for (std::size_t r = 0; r < count; ++r) {
        const MeshSection empty = movedTo(static_cast<std::uint32_t>(mesh.quads.size()), {});
        mesh.meshSections.push_back(hasMeshSection(meshSections, r)
                                        ? buildMeshSection(input, static_cast<int>(r), scratch, mesh.quads)
                                        : empty);
    }
    return mesh;
}

ChunkMesh withMeshSections(const ChunkMesh& old, const ChunkMesh& newer, MeshSectionSet meshSections) {
    base::require(old.meshSections.size() == newer.meshSections.size(),
                  "withMeshSections: the meshes have mesh sections of different heights");
    ChunkMesh mesh;
    mesh.quads.reserve(old.quads.size() + newer.quads.size());
    for (std::size_t r = 0; r < old.meshSections.size(); ++r) {
        const ChunkMesh& from = hasMeshSection(meshSections, r) ? newer : old;
        const MeshSection& meshSection = from.meshSections[r];
        mesh.meshSections.push_back(movedTo(static_cast<std::uint32_t>(mesh.quads.size()), meshSection));
        const auto first = from.quads.begin() + firstQuad(meshSection);
        mesh.quads.insert(mesh.quads.end(), first, first + quadCount(meshSection));
    }
    return mesh;
}

}  // namespace terrane::mesh
