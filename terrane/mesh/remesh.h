// What an edit costs: which regions' meshes change with a block, and a chunk's mesh with only these made
// anew. Called by whoever owns the world (regionsTouchedBy) and by the meshing workers (remeshRegions).
#pragma once

#include <cstdint>
#include <vector>

#include "terrane/mesh/chunk_mesher.h"
#include "terrane/world/coords.h"

namespace terrane::mesh {

// One bit a region, the lowest region in bit 0.
using RegionSet = std::uint32_t;
static_assert(world::kChunkHeight / kMinRegionHeight <= 32);

struct TouchedChunk {
    world::ChunkPos pos;
    RegionSet regions = 0;

    bool operator==(const TouchedChunk&) const = default;
};

// The regions in which a face may change when the block at `pos` (z 0…255) does: its own, and those of the
// six blocks beside it. At most three chunks, the block's own first; none outside the world. Any thread.
std::vector<TouchedChunk> regionsTouchedBy(world::BlockPos pos, int regionHeight);

// `old` with the quads of `regions` made anew from `input`, the others copied: what meshChunk would make now,
// if nothing else changed since `old` was made with the same options.
ChunkMesh remeshRegions(const ChunkMesh& old, const MeshInput& input, RegionSet regions,
                        MeshScratch& scratch);

}  // namespace terrane::mesh
