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
// A thread frees scratch memory beyond this. Sections take 9 KB on average, 0.5 MiB at most.
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

constexpr std::uint8_t kChunkVersion = 1;

// Maximum size before compression: sections take at most 0.5 MiB, the rest is block entity data.
constexpr std::size_t kMaxChunkBytes = 64u << 20;

// Fails if the block entity data exceeds the limit, or a block's id is not mapped. `seed` is the
// checksumSeed() of the row.
[[nodiscard]] base::Result<Bytes> encodeChunk(const world::Chunk& chunk, const BlockIdMap& ids,
                                              std::uint64_t seed = 0);

// Decodes any bytes. The error for invalid bytes gives the reason, without a position. Returns OutOfResources
// if the block entity data exceed the budget.
[[nodiscard]] base::Result<world::Chunk> decodeChunk(ByteView bytes, const BlockIdMap& ids,
                                                     std::uint64_t seed = 0, EntityBudget* budget = nullptr);

// Checks only header and checksum, in 0.1 µs.
[[nodiscard]] base::Result<void> verifyChunk(ByteView bytes, std::uint64_t seed = 0);

// Sets the checksum of an encoded chunk for this seed.
void sealChunk(std::span<std::byte> bytes, std::uint64_t seed);

}  // namespace terrane::store
