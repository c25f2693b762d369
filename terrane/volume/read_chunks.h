// Reads chunks of a world on all of its threads: from the store, else generated. The module's other readers
// use it. Called by any thread, which works too.
#pragma once

#include <cstdint>
#include <functional>

#include "terrane/volume/opened_world.h"

namespace terrane::volume {

// The chunks to read.
struct ChunkList {
    std::int64_t count = 0;
    std::function<world::ChunkPos(std::int64_t number)> at;  // called by several threads
};
ChunkList chunksOf(const world::ChunkArea& area);  // by y, then x

// Calls use(number, chunk) once for each chunk, on several threads and in any order; the chunk is its own.
// Chunks outside the world are empty. Chunks that are damaged in the store are generated. Fails if the store
// could not read a chunk that it may have, if a level has no generator, or if `goesOn` says so.
using UseChunk = std::function<void(std::int64_t number, world::Chunk&& chunk)>;
[[nodiscard]] base::Result<void> readChunks(OpenedWorld& world, const ChunkList& list, const GoesOn& goesOn,
                                            const UseChunk& use);

// Calls work(k) for k = 0 … count − 1 on the world's threads; the calling thread asks goesOn between parts.
// The error is that of the lowest k that has one.
[[nodiscard]] base::Result<void> forEachPart(OpenedWorld& world, std::int64_t count, const GoesOn& goesOn,
                                             const std::function<base::Result<void>(std::int64_t)>& work);

}  // namespace terrane::volume
