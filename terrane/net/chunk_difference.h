// How an edited chunk differs from what the generator makes: all of a world that travels, as every player's
// program generates the rest. Plain values and functions; any thread. docs/protocol.md describes the bytes.
#pragma once

#include <span>
#include <vector>

#include "terrane/net/wire.h"
#include "terrane/world/block_value.h"

namespace terrane::net {

struct ChangedBlock {
    world::BlockIndex index = 0;
    world::BlockValue value;

    bool operator==(const ChangedBlock&) const = default;
};
// By index, in ascending order, each once.
using ChunkDifference = std::vector<ChangedBlock>;

// Block entity data of more bytes does not travel: the block comes without it.
constexpr std::size_t kMaxBlockData = 32768;

// What of `edited` is not as in `generated`.
ChunkDifference chunkDifference(const world::Chunk& generated, const world::Chunk& edited);
void applyDifference(world::Chunk& chunk, std::span<const ChangedBlock> difference);

// The same blocks at their places in the world.
std::vector<world::PlacedBlock> placedBlocks(world::ChunkPos pos, std::span<const ChangedBlock> blocks);

// `to` with the blocks of `newer` in it, or in place of its own.
void mergeInto(ChunkDifference& to, std::span<const ChangedBlock> newer);

// At most so many blocks, and so many bytes of data, are in one message.
constexpr std::size_t kMaxBlocksInPart = 8192;
constexpr std::size_t kMaxDataInPart = 65536;
// Parts of a difference that each fit a message, in order; one empty part where it is empty.
std::vector<std::span<const ChangedBlock>> partsOf(std::span<const ChangedBlock> difference);

// Runs of equal blocks: a wall of 16 blocks takes 3 bytes, a block by itself 2 to 5.
void writeBlocks(WireWriter& wire, std::span<const ChangedBlock> blocks);
void readBlocks(WireReader& wire, ChunkDifference& blocks);

}  // namespace terrane::net
