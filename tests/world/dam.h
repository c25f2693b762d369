// A lake behind a dam above a valley of 64×64 blocks, for tests and benchmarks of flowing water.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "terrane/base/digest.h"
#include "terrane/world/changes/liquid_flow.h"
#include "tests/support/default_heights.h"

namespace terrane::world {

constexpr int kDamX = 12, kLakeTop = 60;
// The chunks where water flows: more than those of the dam.
inline const std::vector<ChunkPos> kDamArea = chunksWithin({2, 2}, 4);

// The chunks of the dam: the 4×4 of the valley and one more around.
inline std::vector<ChunkPos> damChunks() {
    std::vector<ChunkPos> chunks;
    for (int y = -1; y <= 4; ++y)
        for (int x = -1; x <= 4; ++x) chunks.push_back({x, y});
    return chunks;
}

// The valley falls away from the dam in steps, and rises to both sides; around it is rock.
inline int damGroundHeight(int x, int y) {
    const bool isValley = x >= 1 && y >= 1 && x < 63 && y < 63;
    if (!isValley) return kLakeTop + 6;
    const int fromMiddle = std::abs(2 * y - 63) / 2;
    const int bottom = x <= kDamX ? 44 : 44 - (x - kDamX) / 2;
    return std::min(bottom + fromMiddle * fromMiddle / 40, kLakeTop + 6);
}

inline std::shared_ptr<Chunk> damChunk(ChunkPos pos, const BlockRegistry& blocks) {
    const BlockId stone = blocks.find("stone")->id, water = blocks.find("water")->id;
    const BlockId grass = blocks.find("grass")->id, tuft = blocks.find("grass_tuft")->id;
    auto chunk = std::make_shared<Chunk>();
    for (int y = 0; y < kChunkSize; ++y)
        for (int x = 0; x < kChunkSize; ++x) {
            const int worldX = pos.x * kChunkSize + x, worldY = pos.y * kChunkSize + y;
            const int ground = damGroundHeight(worldX, worldY);
            const int rock = worldX == kDamX ? std::max(ground, kLakeTop + 2) : ground;
            for (int z = 0; z < rock; ++z)
                chunk->setBlock(blockIndex(x, y, z), z + 1 < ground ? stone : grass);
            for (int z = rock; worldX < kDamX && z <= kLakeTop; ++z)
                chunk->setBlock(blockIndex(x, y, z), water);
            if (worldX > kDamX && (worldX * 7 + worldY * 3) % 5 == 0)
                chunk->setBlock(blockIndex(x, y, rock), tuft);
        }
    return chunk;
}

inline void breakDam(World& world, const BlockRegistry& blocks, std::vector<BlockEdit>& edits) {
    for (int z = 50; z < kLakeTop + 2; ++z)
        for (int y = 12; y < 52; ++y) applyChange(world, blocks, {kDamX, y, z}, SetBlock{kAir}, edits);
}

// The digest of all blocks and their states.
inline std::string damDigest(const World& world) {
    base::Digest digest;
    for (const ChunkPos pos : damChunks()) {
        const ChunkPtr chunk = world.maybeChunkAt(pos);
        for (int section = 0; chunk && section < kSectionsPerChunk; ++section) {
            std::array<Section::Value, kBlocksPerSection> values;
            for (const Section* part : {&chunk->section(section), &chunk->blockStates(section)}) {
                part->unpack(values);
                digest.update(std::as_bytes(std::span(values)));
            }
        }
    }
    return digest.hex();
}

}  // namespace terrane::world
