// The difference between an edited chunk and the generated one. Only differences are sent: every player's
// program generates the rest itself. Plain values and functions; any thread. docs/protocol.md describes the
// bytes.
#pragma once

#include <span>
#include <vector>

#include "terrane/net/wire/wire.h"
#include "terrane/world/world.h"

namespace terrane::net {

struct ChangedBlock {
    world::BlockIndex index = 0;
    world::BlockValue value;

    bool operator==(const ChangedBlock&) const = default;
};
// Sorted by index; each index occurs once.
using ChunkDifference = std::vector<ChangedBlock>;

// Larger block entity data is not sent: the block is sent without it.
constexpr std::size_t kMaxBlockData = 32768;

// The blocks of `edited` that differ from `generated`.
ChunkDifference chunkDifference(const world::Chunk& generated, const world::Chunk& edited);
void applyDifference(world::Chunk& chunk, std::span<const ChangedBlock> difference);

// Converts block indices to world positions.
std::vector<world::PlacedBlock> placedBlocks(world::ChunkPos pos, std::span<const ChangedBlock> blocks);

// Adds the blocks of `newer` to `to`, replacing those with the same index.
void mergeInto(ChunkDifference& to, std::span<const ChangedBlock> newer);

// Maximum number of blocks, and of bytes of block entity data, in one message.
constexpr std::size_t kMaxBlocksInPart = 8192;
constexpr std::size_t kMaxDataInPart = 65536;
// Splits a difference into parts that each fit a message, in order. An empty difference gives one empty part.
std::vector<std::span<const ChangedBlock>> partsOf(std::span<const ChangedBlock> difference);

// Whether all blocks are in these heights.
bool isWithin(std::span<const ChangedBlock> blocks, world::Heights heights);

// Which indices the bytes can name. `Low`: those of z = 0…255, from 0 on, with 16 bits at block entity data.
// `Any`: those of all heights, from the lowest one on.
enum class IndexRange : std::uint8_t { Low, Any };

// Run-length encoded: a wall of 16 blocks takes 3 bytes, a single block 2 to 5. All blocks are in the range.
void writeBlocks(WireWriter& wire, std::span<const ChangedBlock> blocks, IndexRange range = IndexRange::Any);
void readBlocks(WireReader& wire, ChunkDifference& blocks, IndexRange range = IndexRange::Any);

}  // namespace terrane::net
