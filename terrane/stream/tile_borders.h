// Where chunks of level 0 give way to tiles. A chunk is meshed against its neighbors: where a tile stands in
// a neighbor's place and its land lies lower, a gap would show. So the sides of chunks are open there, as
// those of tiles are (mesh::meshTile): opaque faces go down to the bottom of the world. Used by the chunk
// pipeline. Pure functions but for the table.
#pragma once

#include <cstdint>

#include "terrane/mesh/chunk_mesher.h"
#include "terrane/stream/chunk_table.h"
#include "terrane/stream/tile_table.h"
#include "terrane/world/block_registry.h"

namespace terrane::stream {

// A bit a side, in the order of mesh::MeshBlocks: -x, +x, -y, +y.
using SideSet = std::uint8_t;

// Of a chunk: the sides where tiles lie beyond. None for a chunk whose own place a tile takes.
SideSet openSides(const TileView& view, world::ChunkPos pos);

// What stands beyond an open side while a chunk is meshed: nothing but water, since faces of opaque blocks
// are drawn toward it and those of water are not. Air where there is no liquid.
world::ChunkPtr chunkBeyond(const world::BlockRegistry& blocks);

// Has chunks meshed again whose open sides are others than before.
void remeshBorders(ChunkTable& table, const TileView& before, const TileView& now);

}  // namespace terrane::stream
