// Updates light after blocks have changed: only the changed light is computed again, and only the bricks that
// it reaches are unpacked. The result is, to the bit, that of a world lit from scratch. Any thread: reads
// immutable snapshots and makes new ones.
#pragma once

#include <array>
#include <span>
#include <unordered_map>
#include <vector>

#include "terrane/light/light_chunk.h"
#include "terrane/light/light_sources.h"
#include "terrane/world/changes/block_edit.h"
#include "terrane/world/heights.h"

namespace terrane::light {

// A changed block of the middle chunk. The chunk has the new block.
struct BlockChange {
    world::BlockIndex index = 0;
    world::BlockId before = world::kAir;
};

// 3×3 chunks of the same heights, index x + 3 y. A chunk where either is null is unknown: it counts as dark
// and opaque, and light from or through it is lost.
struct LightWindow {
    std::array<const world::Chunk*, kFieldChunks> chunks{};  // with the changes
    std::array<ChunkLightPtr, kFieldChunks> lights{};        // without them
};

// By chunk.
using ChangedBricks = std::array<world::SectionSet, kFieldChunks>;

// Replaces the lights that change by new ones, which share nothing with the old. A block that changed several
// times is listed in `changes` once, with its first id.
ChangedBricks relight(LightWindow& window, std::span<const BlockChange> changes, const LightTable& table,
                      LightScratch& scratch);

// A chunk and its light, for changes in any chunks at once.

struct LitChunk {
    world::ChunkPtr chunk;
    ChunkLightPtr light;
};
using LitChunks = std::unordered_map<world::ChunkPos, LitChunk, world::ChunkPosHash>;

struct LightChange {
    world::ChunkPos pos;
    world::SectionSet bricks;
};

// Brings the lights of `chunks`, which have the new blocks of all edits, up to date. Edits in chunks that are
// missing or have no light are ignored. Returns each changed chunk once, sorted by position.
std::vector<LightChange> relight(LitChunks& chunks, std::span<const world::BlockEdit> edits,
                                 const LightTable& table, LightScratch& scratch);

}  // namespace terrane::light
