// Checks that the tiles of a store are derived from its edited chunks (tests/store/tile_sums.h).
#pragma once

#include <gtest/gtest.h>

#include <set>
#include <string_view>

#include "terrane/store/chunk_store.h"
#include "tests/store/tile_sums.h"

namespace terrane::store {

// Checks only if the mark is set. No saves may be queued.
inline void expectTiles(ReadableStore& store, std::string_view rules) {
    if (store.metadata(kDerivedRowsMark) != rules) return;
    const auto positions = store.editedChunks();
    ASSERT_TRUE(positions) << positions.error().message;
    std::vector<ChunkRow> edited;
    std::set<world::ChunkPos> places;
    for (const world::ChunkPos pos : *positions) {
        edited.push_back({pos, store.load(pos).chunk});
        places.insert(tileAbove(pos));
        places.insert(tileAbove(tileAbove(pos)));
    }
    const TileMap expected = tilesOf(edited);
    for (const world::ChunkPos pos : places) {
        const LoadedChunk tile = store.load(pos);
        const auto found = expected.find(pos);
        ASSERT_EQ(tile.chunk != nullptr, found != expected.end()) << nameOf(pos);
        if (tile.chunk) {
            ASSERT_TRUE(*tile.chunk == *found->second) << nameOf(pos);
        }
    }
}

}  // namespace terrane::store
