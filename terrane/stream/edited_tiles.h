// Builds the tiles that edits change, level by level, from the chunks and tiles under them. Tiles without
// edits come from the generator. Pure functions of the edited chunks: the order of edits makes no difference.
// Any thread.
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
constexpr int kSeenDepth = 16;

// The tile as edits changed it; null if it equals the generated one. `children`: the edited chunks or tiles
// under it, in the order (0, 0), (1, 0), (0, 1), (1, 1); null for generated ones.
//
// A column is made from the four under it (world/downsample.h) if the rule gives another result for the
// edited four than for the generated four, at a visible height: above the child's lowest ground (of edited
// and generated columns, the first opaque block from above) less kSeenDepth. All other columns are the
// generator's. So mines change nothing, nor does what is too small for the level. Costs one generated tile
// and one for each edited child.
world::ChunkPtr editedTile(const gen::LevelGenerators& generators, const world::DownsampleRule& rule,
                           world::ChunkPos tile, const std::array<world::ChunkPtr, 4>& children);

struct TileChange {
    world::ChunkPos pos;
    world::ChunkPtr tile;  // null: no edit is visible any more
};

// The edited chunk or the stored tile at a position; null if there is none.
using ReadTile = std::function<world::ChunkPtr(world::ChunkPos)>;

// The tiles that change after edits of these chunks (of level 0), lowest level first: up to `topLevel`, or as
// far as there are generators. `read` gives the new chunks and the old tiles. Does not go on above tiles that
// stay the same.
std::vector<TileChange> tilesAfterEdits(const gen::LevelGenerators& generators,
                                        const world::DownsampleRule& rule,
                                        std::span<const world::ChunkPos> editedChunks, const ReadTile& read,
                                        int topLevel = world::kMaxLevel);

// Keeps the tiles that edits change in the store, as rows derived from the edited chunks (docs/levels.md).
// From now on the store writes these rows with the chunks that they are derived from, and calls the listener,
// unless empty. `generators` outlives the store.
void keepTileRows(store::ChunkStore& store, const gen::LevelGenerators& generators,
                  const world::BlockRegistry& blocks, TileListener listener);

// Builds the rows of a world that lacks them, after keepTileRows() and before tiles are loaded: takes some
// milliseconds for each edited chunk, and no time if the rows exist. If it fails, the store is unchanged.
[[nodiscard]] base::Result<void> buildTileRows(store::ChunkStore& store);

}  // namespace terrane::stream
