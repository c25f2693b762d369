#include "terrane/mesh/remesh.h"

#include <cassert>
#include <cstddef>

namespace terrane::mesh {
namespace {

RegionSet regionAt(int z, int regionHeight) {
    return world::isInHeight(z) ? RegionSet{1} << (z / regionHeight) : RegionSet{0};
}

// Appends a region's quads, which lie together, and says where they are now.
RegionMesh copyRegion(const ChunkMesh& from, const RegionMesh& region, std::vector<shared::Quad>& quads) {
    const std::uint32_t first = region.groups[0][0].first;
    const QuadRange last = region.groups[kContextCount - 1][kGroupCount - 1];
    const auto moved = static_cast<std::uint32_t>(quads.size()) - first;
    RegionMesh copy = region;
    for (auto& context : copy.groups) {
        for (QuadRange& range : context) range.first += moved;
    }
    quads.insert(quads.end(), from.quads.begin() + first, from.quads.begin() + last.first + last.count);
    return copy;
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
        const world::ChunkPos beside{chunk.x + dx, chunk.y + dy};
        if (world::isInWorld(beside)) touched.push_back({beside, own});
    };
    const int x = pos.x & 15, y = pos.y & 15;
    if (x == 0) addBeside(-1, 0);
    if (x == 15) addBeside(1, 0);
    if (y == 0) addBeside(0, -1);
    if (y == 15) addBeside(0, 1);
    return touched;
}

ChunkMesh remeshRegions(const ChunkMesh& old, const MeshInput& input, RegionSet regions,
                        MeshScratch& scratch) {
    const auto count = static_cast<std::size_t>(world::kChunkHeight / input.options.regionHeight);
    assert(old.regions.size() == count && "made with the same options");
    ChunkMesh mesh;
    mesh.quads.reserve(old.quads.size());
    for (std::size_t r = 0; r < count; ++r) {
        const bool isTouched = (regions >> r & 1) != 0;
        mesh.regions.push_back(isTouched ? meshRegion(input, static_cast<int>(r), scratch, mesh.quads)
                                         : copyRegion(old, old.regions[r], mesh.quads));
    }
    return mesh;
}

}  // namespace terrane::mesh
