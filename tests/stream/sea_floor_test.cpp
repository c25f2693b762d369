#include "terrane/stream/tile_pipeline.h"

#include <gtest/gtest.h>

#include <random>

#include "terrane/mesh/chunk_mesher.h"
#include "tests/support/default_heights.h"

namespace terrane::stream {
namespace {

using world::blockIndex;

constexpr const char* kBlocks = R"(
block = [
    { name = "stone", shape = "cube", texture = "stone" },
    { name = "sand", shape = "cube", texture = "sand" },
    { name = "water", shape = "liquid", texture = "water", alpha = "blend", opacity = 1, surface_height = 0.75 },
]
)";
constexpr int kSea = 70;  // highest block of the water

class SeaFloorTest : public testing::Test {
  protected:
    world::BlockId id(const char* name) const { return blocks_.find(name)->id; }
    // Ground up to `ground`, water above it up to the sea.
    void fill(world::Chunk& chunk, int x, int y, int ground, const char* kind = "stone") const {
        for (int z = 0; z <= ground; ++z) chunk.setBlock(blockIndex(x, y, z), id(kind));
        for (int z = ground + 1; z <= kSea; ++z) chunk.setBlock(blockIndex(x, y, z), id("water"));
    }

    world::BlockRegistry blocks_ = world::BlockRegistry::parse(kBlocks, "blocks").value();
};

TEST_F(SeaFloorTest, WhatCanBeSeenStaysAsItIs) {
    std::mt19937 random(7);
    world::Chunk chunk;
    std::array<int, 256> ground{};
    for (int k = 0; k < 256; ++k) {
        ground[static_cast<std::size_t>(k)] = 20 + static_cast<int>(random() % 60);
        fill(chunk, k % 16, k / 16, ground[static_cast<std::size_t>(k)], k % 2 ? "sand" : "stone");
    }
    const world::Chunk before = chunk;
    raiseDeepFloor(chunk, blocks_);
    for (int k = 0; k < 256; ++k) {
        const int was = ground[static_cast<std::size_t>(k)];
        for (int z = 0; z < world::kChunkHeight; ++z) {
            const auto at = blockIndex(k % 16, k / 16, z);
            const bool isRaised = was < kSea - kMaxVisibleDepth && z >= was && z <= kSea - kMaxVisibleDepth;
            if (isRaised) {
                ASSERT_TRUE(blocks_.type(chunk.block(at)).opaqueCube) << k << " " << z;
            } else {
                ASSERT_EQ(chunk.block(at), before.block(at)) << k << " " << z;
            }
        }
    }
}

TEST_F(SeaFloorTest, DeepSeaHasOneQuadForItsFloor) {
    world::Chunk chunk;
    for (int k = 0; k < 256; ++k) fill(chunk, k % 16, k / 16, 10 + k % 7);
    const auto quads = [&] { return mesh::meshAlone(chunk, blocks_).quads.size(); };
    const std::size_t before = quads();
    raiseDeepFloor(chunk, blocks_);
    EXPECT_GT(before, 100u);
    EXPECT_LE(quads(), 40u) << "sides, the sea, the floor";
}

TEST_F(SeaFloorTest, PondsAndCavesUnderLandStay) {
    world::Chunk chunk;
    for (int k = 0; k < 256; ++k) fill(chunk, k % 16, k / 16, 30);
    for (int k = 0; k < 256; ++k) chunk.setBlock(blockIndex(k % 16, k / 16, kSea + 1), id("stone"));
    const world::Chunk before = chunk;
    raiseDeepFloor(chunk, blocks_);
    EXPECT_EQ(chunk, before);
}

}  // namespace
}  // namespace terrane::stream
