// Lights chunks from scratch, in two stages that may each run on any thread:
//
//   1. solveLocal: the light of a chunk's own blocks, as if darkness surrounded it.
//   2. lightChunk: the light of a chunk, from the results of stage 1 for it and its eight neighbors.
//
// Light travels at most 15 blocks, so chunks farther away do not matter: the result is that of the whole
// world. docs/light.md has the model and the proofs.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "terrane/light/chunk_light.h"
#include "terrane/light/light_field.h"
#include "terrane/light/light_sources.h"

namespace terrane::light {

// The result of stage 1; it is immutable and shared between threads. It is unpacked, with 17 KiB for each
// brick that is not uniform: about 110 KB in the overworld, in worlds of any heights. It is needed until the
// chunk and its eight neighbors are lit.
struct LocalLight {
    // Light at x = 0 or x = 15, index y + 16 z.
    using SideLevels = std::array<LightValue, world::kSectionSize * world::kSectionSize>;

    // Bricks with their west and east sides.
    struct Run {
        BrickRun bricks;
        const LightValue *west = nullptr, *east = nullptr;  // SideLevels
    };

    world::Heights heights;
    std::vector<Run> runs;  // from the top to the bottom
    std::vector<std::unique_ptr<Brick>> owned;
    std::vector<SideLevels> ownedSides;

    std::size_t memoryBytes() const {
        return sizeof(LocalLight) + runs.size() * sizeof(Run) + owned.size() * sizeof(Brick) +
               ownedSides.size() * sizeof(SideLevels);
    }
};

// Memory that a worker reuses from chunk to chunk; it has no state between calls.
struct LightScratch {
    LightField field;
    LightField decreaseQueue;  // for relight.h
};

LocalLight solveLocal(const world::Chunk& chunk, const LightTable& table, LightScratch& scratch);

// The index is x + 3 y, with the chunk itself in the middle (4). A null chunk is unknown: it counts as dark
// and opaque; the result is then that of a world that ends there. All have the same heights.
using LocalLightNeighborhood = std::array<const LocalLight*, kFieldChunks>;

ChunkLight lightChunk(const LocalLightNeighborhood& chunks, LightScratch& scratch);

}  // namespace terrane::light
