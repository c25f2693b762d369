// Borders between chunks of level 0 and tiles. A chunk is meshed against its neighbors: if a tile with lower
// land is in a neighbor's place, a gap would be visible. So the sides of chunks are open there, as those of
// tiles are (mesh::meshTile): opaque faces go down to the bottom of the world. Used by the chunk pipeline.
// Pure functions but for the table.
#pragma once

#include <cstdint>

#include "terrane/mesh/chunk_mesher.h"
#include "terrane/stream/chunk_table.h"
#include "terrane/stream/tile_table.h"
#include "terrane/world/block_registry.h"

namespace terrane::stream {

// A bit for each side, in the order of mesh::MeshBlocks: -x, +x, -y, +y.
using SideSet = std::uint8_t;

// The sides of a chunk beyond which tiles lie. None for a chunk in whose own place a tile is.
SideSet openSides(const TileView& view, world::ChunkPos pos);

// The neighbor beyond an open side for meshing: all water, since faces of opaque blocks are drawn toward it
// and those of water are not. Air if there is no liquid.
world::ChunkPtr chunkBeyond(const world::BlockRegistry& blocks);

// Requests new meshes of chunks whose open sides changed.
void remeshBorders(ChunkTable& table, const TileView& before, const TileView& now);

}  // namespace terrane::stream
