#include "terrane/mesh/remesh.h"

#include "terrane/base/result.h"
#include "terrane/mesh/mesh_section_quads.h"

namespace terrane::mesh {
namespace {

constexpr world::Heights kAllHeights{world::kLowestBottom, world::kHighestTop};

void append(ChunkMesh& mesh, const ChunkMesh& from, const MeshSection& meshSection) {
    mesh.meshSections.push_back(movedTo(static_cast<std::uint32_t>(mesh.quads.size()), meshSection));
    const auto first = from.quads.begin() + firstQuad(meshSection);
    mesh.quads.insert(mesh.quads.end(), first, first + quadCount(meshSection));
}

}  // namespace

std::vector<TouchedChunk> meshSectionsTouchedBy(world::BlockPos pos) {
    base::require(kAllHeights.contains(pos.z),
                  "meshSectionsTouchedBy: the block is above or below every world");
    MeshSectionSet own, around;
    own.add(pos.z >> 3);
    for (int z = pos.z - 1; z <= pos.z + 1; ++z)
        if (kAllHeights.contains(z)) around.add(z >> 3);
    const world::ChunkPos chunk = world::chunkOf(pos);
    std::vector<TouchedChunk> touched{{chunk, around}};
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

ChunkMesh buildMeshSections(const MeshInput& input, const MeshSectionSet& meshSections,
                            MeshScratch& scratch) {
    base::require(input.center, "buildMeshSections: the chunk is null");
    MeshSectionSet joined = meshSections;
    joined |= MeshSectionSet::all(input.center->heights());
    if (joined == meshSections) return meshChunk(input, scratch);
    ChunkMesh mesh;
    forEachMeshSection(input, [&](int bottom, int top) {
        if (!meshSections.hasAny(bottom, top)) return;
        if (const auto made = buildMeshSection(input, bottom, scratch, mesh.quads))
            mesh.meshSections.push_back(*made);
    });
    return mesh;
}

// Both are in the order of their heights.
ChunkMesh withMeshSections(const ChunkMesh& old, const ChunkMesh& newer, const MeshSectionSet& meshSections) {
    ChunkMesh mesh;
    mesh.quads.reserve(old.quads.size() + newer.quads.size());
    auto added = newer.meshSections.begin();
    const auto appendBelow = [&](int bottom) {
        for (; added != newer.meshSections.end() && added->bottom < bottom; ++added)
            if (meshSections.has(*added)) append(mesh, newer, *added);
    };
    for (const MeshSection& kept : old.meshSections) {
        if (meshSections.has(kept)) continue;
        appendBelow(kept.bottom);
        append(mesh, old, kept);
    }
    appendBelow(world::kHighestTop);
    return mesh;
}

}  // namespace terrane::mesh
