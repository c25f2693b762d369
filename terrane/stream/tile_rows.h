// Keeps the tiles that edits change in the store, as rows derived from the edited chunks (docs/levels.md).
#pragma once

#include "terrane/base/result.h"
#include "terrane/gen/level_generators.h"
#include "terrane/store/chunk_store.h"
#include "terrane/stream/tile_pipeline.h"
#include "terrane/world/block_registry.h"

namespace terrane::stream {

// From now on the store writes these rows with the chunks that they are derived from, and calls the listener,
// unless empty. `generators` outlives the store.
void keepTileRows(store::ChunkStore& store, const gen::LevelGenerators& generators,
                  const world::BlockRegistry& blocks, TileListener listener);

// Builds the rows of a world that lacks them, after keepTileRows() and before tiles are loaded: takes some
// milliseconds for each edited chunk, and no time if the rows exist. If it fails, the store is unchanged.
[[nodiscard]] base::Result<void> buildTileRows(store::ChunkStore& store);

}  // namespace terrane::stream
