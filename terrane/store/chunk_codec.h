// A chunk as the bytes that a save keeps, and back. docs/file-format.md describes them. Any thread may call.
//
// Equal chunks give equal bytes (with one version of zstd), however they came to be. Measured on the
// overworld: 634 bytes a chunk.
#pragma once

#include "terrane/base/result.h"
#include "terrane/store/block_id_map.h"
#include "terrane/store/bytes.h"
#include "terrane/store/entity_budget.h"
#include "terrane/world/chunk.h"

namespace terrane::store {

constexpr std::uint8_t kChunkVersion = 1;

// What a chunk may take before compression: its sections 0.5 MiB at most, the rest is block entity data.
constexpr std::size_t kMaxChunkBytes = 64u << 20;

// An error where the chunk's block entity data is more than a save keeps, or a block's id stands for nothing.
// `seed`: checksumSeed() of the row.
[[nodiscard]] base::Result<Bytes> encodeChunk(const world::Chunk& chunk, const BlockIdMap& ids,
                                              std::uint64_t seed = 0);

// Any bytes may be given: what is no chunk is an error that says why, without a position. OutOfResources
// where its block entity data do not fit the budget, if there is one.
[[nodiscard]] base::Result<world::Chunk> decodeChunk(ByteView bytes, const BlockIdMap& ids,
                                                     std::uint64_t seed = 0, EntityBudget* budget = nullptr);

// Header and checksum alone: whether these are the bytes that were once written. 0.1 µs.
[[nodiscard]] base::Result<void> verifyChunk(ByteView bytes, std::uint64_t seed = 0);

// The bytes of an encoded chunk get the checksum by this seed.
void sealChunk(std::span<std::byte> bytes, std::uint64_t seed);

}  // namespace terrane::store
