// Encodes a chunk as saved, and decodes it. docs/file-format.md describes the format. Any thread may call the
// functions.
//
// Equal chunks have equal encodings (with one version of zstd), independent of their edit history. Measured
// on the overworld: 634 bytes per chunk.
#pragma once

#include "terrane/base/result.h"
#include "terrane/store/chunks/block_id_map.h"
#include "terrane/store/chunks/bytes.h"
#include "terrane/store/chunks/entity_budget.h"
#include "terrane/world/chunk.h"

namespace terrane::store {

// Per-thread scratch memory for uncompressed chunks.
// A thread frees scratch memory beyond this. Sections take 9 KB on average; those of 256 layers take 0.25 MiB
// at most, those of 4,096 layers 4 MiB.
constexpr std::size_t kMaxScratchBytes = 1u << 20;

// The calling thread's scratch memory, empty at first. A thread may have one object at a time.
class Scratch {
  public:
    Scratch() { memory().clear(); }
    ~Scratch() {
        if (memory().capacity() > kMaxScratchBytes) Bytes().swap(memory());
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    Bytes& bytes() { return memory(); }

  private:
    static Bytes& memory() {
        thread_local Bytes bytes;
        return bytes;
    }
};

// The version of chunk data follows from the heights of the world: version 1 has 16 sections and 16-bit
// indices of blocks, version 2 any heights.
constexpr std::uint8_t kLowChunkVersion = 1, kTallChunkVersion = 2;
constexpr std::uint8_t chunkVersion(world::Heights heights) {
    return heights == world::Heights() ? kLowChunkVersion : kTallChunkVersion;
}

// Maximum size before compression: sections take at most 4 MiB, the rest is block entity data.
constexpr std::size_t kMaxChunkBytes = 64u << 20;

// Fails if the block entity data exceeds the limit, or a block's id is not mapped. `seed` is the
// checksumSeed() of the row.
[[nodiscard]] base::Result<Bytes> encodeChunk(const world::Chunk& chunk, const BlockIdMap& ids,
                                              std::uint64_t seed = 0);

// Decodes any bytes of a world of these heights. The error for invalid bytes gives the reason, without a
// position. Returns OutOfResources if the block entity data exceed the budget.
[[nodiscard]] base::Result<world::Chunk> decodeChunk(ByteView bytes, const BlockIdMap& ids,
                                                     world::Heights heights, std::uint64_t seed = 0,
                                                     EntityBudget* budget = nullptr);

// Checks only header and checksum, in 0.1 µs.
[[nodiscard]] base::Result<void> verifyChunk(ByteView bytes, world::Heights heights, std::uint64_t seed = 0);

// Sets the checksum of an encoded chunk for this seed.
void sealChunk(std::span<std::byte> bytes, std::uint64_t seed);

}  // namespace terrane::store
