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

void addFromSection(const Chunk& chunk, ChunkPos pos, int number, const BlockRegistry& blocks,
                    std::uint64_t tick, std::vector<BlockPos>& ticked) {
    const std::uint32_t place =
        shared::hash2(static_cast<std::uint32_t>(pos.x), static_cast<std::uint32_t>(pos.y), kSeed);
    for (int pick = 0; pick < kTickPicks; ++pick) {
        const std::uint32_t when =
            shared::hash2(static_cast<std::uint32_t>(tick), static_cast<std::uint32_t>(tick >> 32),
                          static_cast<std::uint32_t>(number * kTickPicks + pick));
        const auto inSection =
            static_cast<int>((place ^ when) % static_cast<std::uint32_t>(kBlocksPerSection));
        const auto index = number * kBlocksPerSection + inSection;
        const BlockType& type = blocks.type(chunk.block(index));
        if (chunk.blockState(index) == 0 || !behaviorWith(type, &BlockBehavior::tick)) continue;
        const BlockPos at = blockPos(pos, index);
        if (std::find(ticked.begin(), ticked.end(), at) == ticked.end()) ticked.push_back(at);
    }
}

}  // namespace

std::vector<BlockPos> blocksToTick(const World& world, const BlockRegistry& blocks, std::uint64_t tick,
                                   std::span<const ChunkPos> chunks) {
    std::vector<BlockPos> ticked;
    for (const ChunkPos pos : chunks) {
        const ChunkPtr chunk = world.maybeChunkAt(pos);
        if (!chunk) continue;
        for (int number = chunk->heights().firstSection(); number < chunk->heights().endSection(); ++number) {
            if (!hasBlockState(chunk->blockStates(number))) continue;
            addFromSection(*chunk, pos, number, blocks, tick, ticked);
        }
    }
    return ticked;
}

}  // namespace terrane::world
