// What an edit costs: which regions' meshes change with a block, and the mesh of only these. Called by
// whoever owns the world; pure functions, any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "terrane/mesh/chunk_mesher.h"
#include "terrane/world/coords.h"

namespace terrane::mesh {

// One bit a region, the lowest region in bit 0.
using RegionSet = std::uint32_t;
constexpr RegionSet kAllRegions = ~RegionSet{0};
static_assert(world::kChunkHeight / kMinRegionHeight <= 32);

constexpr bool hasRegion(RegionSet regions, std::size_t region) {
    return (regions >> region & 1) != 0;
}

struct TouchedChunk {
    world::ChunkPos pos;
    RegionSet regions = 0;

    bool operator==(const TouchedChunk&) const = default;
};

// The regions in which a face may change when the block at `pos` (z 0…255) does: its own, and those of the
// six blocks beside it. At most three chunks, the block's own first; none outside the world.
std::vector<TouchedChunk> regionsTouchedBy(world::BlockPos pos, int regionHeight);

// What meshChunk makes of these regions; the others have no quads. Bits beyond the highest region are passed
// over.
ChunkMesh meshRegions(const MeshInput& input, RegionSet regions, MeshScratch& scratch);

// `old` with `regions` as `newer` has them: both were made with the same options.
ChunkMesh withRegions(const ChunkMesh& old, const ChunkMesh& newer, RegionSet regions);

}  // namespace terrane::mesh
