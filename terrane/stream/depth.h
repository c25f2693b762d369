// Decides how deep chunks are made: below what is open, and deeper near a camera. What is lower is closed and
// dark (world::kUnmade) until somebody needs it.
//
// A section is open if daylight enters it straight from above, or if it is empty like the section above it
// (light/light_sources.h): the land under an island in the sky is open, and a cave is not. A chunk is lit and
// meshed once it and its eight neighbors are made down to the same section, two below the lowest open one of
// the nine. Where one of them turns out to be open deeper, its neighbors follow. Daylight travels 14 blocks
// from where it falls, so the light of a chunk is that of whole columns.
//
// The second of the pipeline's schedulers (chunk_table.h).
#pragma once

#include <optional>
#include <vector>

#include "terrane/stream/chunk_table.h"

namespace terrane::stream {

// Returns whether chunks of a world are made as deep as they are needed. Those of the default heights are
// whole: what they have below is little, and in a store it is there for everyone.
inline bool hasPartialChunks(world::Heights heights) {
    return heights != world::Heights();
}

// Sections below the lowest open one: daylight spreads into the first of them and ends there. In the second
// one light of lamps may be missing, where lamps are below.
constexpr int kClosedSections = 2;
// Chunks up to kNearChunks (Chebyshev) from a camera are made to at least kNearBlocks below it. The bottom is
// a multiple of kNearStep blocks, so that a falling camera does not ask for each section by itself.
constexpr int kNearChunks = 8, kNearBlocks = 64, kNearStep = 32;

// Sets the camera's height, z of a block. Without one, all chunks are made to the bottom of the world.
void setCameraHeight(ChunkTable& table, std::optional<int> z);

// The 3×3 chunks around one, which are all loaded.
struct DepthAround {
    int needed = 0;   // the section down to which all of them must be made before the middle one is lit
    int highest = 0;  // the highest of the sections down to which they are
    DepthsAround depths{};

    bool isDeepEnough() const { return highest <= needed; }
};

// Returns nothing unless the chunk and its neighbors are loaded.
std::optional<DepthAround> depthAround(const ChunkTable& table, world::ChunkPos pos);

// Returns the section down to which an absent chunk is loaded, as far as that is known. Open sections of the
// chunk itself may need more.
int depthToLoad(const ChunkTable& table, world::ChunkPos pos);

// Requests that a loaded chunk is made down to a section.
void requestDepth(ChunkTable& table, world::ChunkPos pos, int section);
// Returns whether the 3×3 is deep enough; else requests what it lacks.
bool requestMissingDepth(ChunkTable& table, world::ChunkPos pos, const DepthAround& around);
// Requests what the chunks of the 3×3 need, and the light of those for which it is there; visible ones are
// lit again. Call it when the chunk in the middle is loaded, made deeper, or open deeper: visible chunks stay
// visible when those around them are unloaded and loaded again.
void updateDepthAround(ChunkTable& table, world::ChunkPos pos);
// Does the same for the chunks near the camera. Call it when the view moved.
void updateDepthNearCamera(ChunkTable& table);

// Returns the number of loads after which chunks in view may need more depth: a chunk may be visible before
// those around it are loaded.
std::size_t pendingLoads(const ChunkTable& table);

// Returns a section that is no higher than any that a chunk of the view needs.
int lowestNeeded(const ChunkTable& table);

struct DepthJob {
    world::ChunkPos pos;
    int section = 0;
};

// Removes and returns up to `limit` loaded chunks to make deeper. Each has one job at a time.
std::vector<DepthJob> popDepthJobs(ChunkTable& table, std::size_t limit);
// Ends the job of a chunk, which is now as deep as said. Returns false if it is not loaded any more.
bool finishDepthJob(ChunkTable& table, world::ChunkPos pos, LoadedDepths depths);

}  // namespace terrane::stream
