#include "terrane/world/changes/random_ticks.h"

#include <algorithm>

#include "terrane/shared/hash.h"
#include "terrane/world/blocks/block_behavior.h"

namespace terrane::world {
namespace {

constexpr std::uint32_t kSeed = 0x67726f77;  // "grow"

bool hasBlockState(const Section& blockState) {
    return !blockState.isUniform() || blockState.uniformValue() != 0;
}

// Adds the blocks of a section that chance picks and `isWanted` accepts, by their index in the chunk.
template <class IsWanted>
void addPicked(ChunkPos pos, int number, std::uint64_t tick, const IsWanted& isWanted,
               std::vector<BlockPos>& picked) {
    const std::uint32_t place =
        shared::hash2(static_cast<std::uint32_t>(pos.x), static_cast<std::uint32_t>(pos.y), kSeed);
    for (int pick = 0; pick < kTickPicks; ++pick) {
        const std::uint32_t when =
            shared::hash2(static_cast<std::uint32_t>(tick), static_cast<std::uint32_t>(tick >> 32),
                          static_cast<std::uint32_t>(number * kTickPicks + pick));
        const auto inSection =
            static_cast<int>((place ^ when) % static_cast<std::uint32_t>(kBlocksPerSection));
        const auto index = number * kBlocksPerSection + inSection;
        if (!isWanted(index)) continue;
        const BlockPos at = blockPos(pos, index);
        if (std::find(picked.begin(), picked.end(), at) == picked.end()) picked.push_back(at);
    }
}

// Calls `add` with each loaded chunk, its position and the number of each of its sections.
template <class Add>
void forEachSection(const World& world, std::span<const ChunkPos> chunks, const Add& add) {
    for (const ChunkPos pos : chunks) {
        const ChunkPtr chunk = world.maybeChunkAt(pos);
        if (!chunk) continue;
        for (int number = chunk->heights().firstSection(); number < chunk->heights().endSection(); ++number)
            add(*chunk, pos, number);
    }
}

}  // namespace

std::vector<BlockPos> blocksToTick(const World& world, const BlockRegistry& blocks, std::uint64_t tick,
                                   std::span<const ChunkPos> chunks) {
    std::vector<BlockPos> ticked;
    forEachSection(world, chunks, [&](const Chunk& chunk, ChunkPos pos, int number) {
        if (!hasBlockState(chunk.blockStates(number))) return;
        const auto isWanted = [&](int index) {
            return chunk.blockState(index) != 0 &&
                   behaviorWith(blocks.type(chunk.block(index)), &BlockBehavior::tick) != nullptr;
        };
        addPicked(pos, number, tick, isWanted, ticked);
    });
    return ticked;
}

std::vector<BlockPos> blocksOfKinds(const World& world, const std::set<BlockId>& kinds, std::uint64_t tick,
                                    std::span<const ChunkPos> chunks) {
    std::vector<BlockPos> picked;
    forEachSection(world, chunks, [&](const Chunk& chunk, ChunkPos pos, int number) {
        if (!chunk.isMade(number)) return;
        const Section& section = chunk.section(number);
        if (section.isUniform() && !kinds.contains(static_cast<BlockId>(section.uniformValue()))) return;
        addPicked(
            pos, number, tick, [&](int index) { return kinds.contains(chunk.block(index)); }, picked);
    });
    return picked;
}

}  // namespace terrane::world
