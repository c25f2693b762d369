// Builds the tiles that edits change, level by level, from the chunks and tiles under them. Tiles without
// edits come from the generator. Pure functions of the edited chunks: the order of edits makes no difference.
// Any thread may use it.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/gen/level_generators.h"
#include "terrane/store/chunk_store.h"
#include "terrane/stream/tile_pipeline.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/chunk.h"
#include "terrane/world/downsample.h"

namespace terrane::stream {

// The depth below the lowest ground of a chunk down to which edits count: its neighbors' ground may be lower,
// and then its side is visible.
constexpr int kVisibleDepth = 16;

struct TileChange {
    world::ChunkPos pos;
    world::ChunkPtr tile;  // null: no edit is visible any more
};

// Returns the edited chunk or the stored tile at a position; null if there is none.
using ReadTile = std::function<world::ChunkPtr(world::ChunkPos)>;

// Returns the tiles that change after edits of these chunks (of level 0), lowest level first: up to
// `topLevel`, or as far as there are generators. `read` returns the new chunks and the old tiles. The search
// stops above tiles that stay the same.
//
// A column of a tile is downsampled from the four columns below it (world/downsample.h) if the rule gives
// another result for the edited four than for the generated four at a visible height: above the child's
// lowest ground (of edited and generated columns, the first opaque block from above) less kVisibleDepth. All
// other columns are the generator's, so mines and edits too small for the level change nothing. Each tile
// costs one generated tile and one more for each edited child.
std::vector<TileChange> tilesAfterEdits(const gen::LevelGenerators& generators,
                                        const world::DownsampleRule& rule,
                                        std::span<const world::ChunkPos> editedChunks, const ReadTile& read,
                                        int topLevel = world::kMaxLevel);

// Makes the store write the tiles that edits change, as rows derived from the edited chunks (docs/levels.md),
// in one transaction with these chunks. It calls the listener, unless empty. `generators` outlives the store.
void maintainTileRows(store::ChunkStore& store, const gen::LevelGenerators& generators,
                      const world::BlockRegistry& blocks, TileListener listener);

// Builds the rows of a world that lacks them, after maintainTileRows() and before tiles are loaded: takes
// some milliseconds for each edited chunk, and no time if the rows exist. If it fails, the store is
// unchanged.
[[nodiscard]] base::Result<void> buildTileRows(store::ChunkStore& store);

}  // namespace terrane::stream
