// Which tiles players' edits make different, and how these look. Tiles without edits come straight from the
// generator; the others are built here, level by level, from the chunks and tiles under them. Pure functions
// of the edited chunks: in which order edits came makes no difference. Any thread.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "terrane/gen/level_generators.h"
#include "terrane/world/chunk.h"
#include "terrane/world/downsample.h"

namespace terrane::stream {

// How far below the lowest ground of a chunk an edit still counts: its neighbors' ground may lie lower, and
// then its side is seen.
constexpr int kSeenDepth = 16;

// The tile as edits changed it; null where it is as the generator makes it. `children`: the edited chunks
// or tiles under it, in the order (0, 0), (1, 0), (0, 1), (1, 1); null where they are as generated.
//
// A column is made from the four under it (world/downsample.h) where the rule makes something else of the
// edited four than of the generated four, at a height that can be seen: above the child's lowest ground (of
// edited and generated columns, the first opaque block from above) less kSeenDepth. All others are the
// generator's. So mines change nothing, nor does what is too small for the level.
// Costs one generated tile and one for each edited child.
world::ChunkPtr editedTile(const gen::LevelGenerators& generators, const world::DownsampleRule& rule,
                           world::ChunkPos tile, const std::array<world::ChunkPtr, 4>& children);

struct TileChange {
    world::ChunkPos pos;
    world::ChunkPtr tile;  // null: no edit is seen any more
};

// The edited chunk or the stored tile at a position; null where there is none.
using ReadTile = std::function<world::ChunkPtr(world::ChunkPos)>;

// What becomes of the tiles when these chunks (of level 0) have changed, lowest level first: up to
// `topLevel`, or as far as there are generators. `read` gives the chunks as they are now and the tiles as
// they were. Stops where a tile stays as it was.
std::vector<TileChange> tilesAfterEdits(const gen::LevelGenerators& generators,
                                        const world::DownsampleRule& rule,
                                        std::span<const world::ChunkPos> editedChunks, const ReadTile& read,
                                        int topLevel = world::kMaxLevel);

}  // namespace terrane::stream
