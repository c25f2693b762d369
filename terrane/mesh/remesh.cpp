#include "terrane/mesh/remesh.h"

#include <cassert>
#include <cstddef>

#include "terrane/mesh/region_quads.h"

namespace terrane::mesh {
namespace {

RegionSet regionAt(int z, int regionHeight) {
    return world::isInHeight(z) ? RegionSet{1} << (z / regionHeight) : RegionSet{0};
}

}  // namespace

std::vector<TouchedChunk> regionsTouchedBy(world::BlockPos pos, int regionHeight) {
    assert(world::isInHeight(pos.z) && "a block of the world");
    assert(isRegionHeight(regionHeight) && "a power of two, 8 to 128");
    const RegionSet own = regionAt(pos.z, regionHeight);
    const world::ChunkPos chunk = world::chunkOf(pos);
    std::vector<TouchedChunk> touched{
        {chunk, own | regionAt(pos.z - 1, regionHeight) | regionAt(pos.z + 1, regionHeight)}};
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

ChunkMesh meshRegions(const MeshInput& input, RegionSet regions, MeshScratch& scratch) {
    if (regions == kAllRegions) return meshChunk(input, scratch);
    ChunkMesh mesh;
    const auto count = static_cast<std::size_t>(world::kChunkHeight / input.options.regionHeight);
    for (std::size_t r = 0; r < count; ++r) {
        const RegionMesh empty = movedTo(static_cast<std::uint32_t>(mesh.quads.size()), {});
        mesh.regions.push_back(
            hasRegion(regions, r) ? meshRegion(input, static_cast<int>(r), scratch, mesh.quads) : empty);
    }
    return mesh;
}

ChunkMesh withRegions(const ChunkMesh& old, const ChunkMesh& newer, RegionSet regions) {
    assert(old.regions.size() == newer.regions.size() && "made with the same options");
    ChunkMesh mesh;
    mesh.quads.reserve(old.quads.size() + newer.quads.size());
    for (std::size_t r = 0; r < old.regions.size(); ++r) {
        const ChunkMesh& from = hasRegion(regions, r) ? newer : old;
        const RegionMesh& region = from.regions[r];
        mesh.regions.push_back(movedTo(static_cast<std::uint32_t>(mesh.quads.size()), region));
        const auto first = from.quads.begin() + firstQuad(region);
        mesh.quads.insert(mesh.quads.end(), first, first + quadCount(region));
    }
    return mesh;
}

}  // namespace terrane::mesh
