#include "terrane/light/light_chunk.h"

#include <gtest/gtest.h>

#include "terrane/base/job_system.h"
#include "tests/light/reference_light.h"
#include "tests/support/depth.h"

namespace terrane::light {
namespace {

// Runs both stages for the chunk in the middle of 3×3.
ChunkLight lightMiddle(const TestArea& area, LightScratch& scratch) {
    std::vector<LocalLight> locals;
    for (const world::Chunk& chunk : area.chunks)
        locals.push_back(solveLocal(chunk, contentTable(), scratch));
    LocalLightNeighborhood around;
    for (std::size_t k = 0; k < around.size(); ++k) around[k] = &locals[k];
    return lightChunk(around, scratch);
}

// Chunks beyond the 3×3 do not matter: the reference has 5×5.
void expectExact(const TestArea::Source& source, LightScratch& scratch) {
    const TestArea small(3, 3, [&](int x, int y, int z) { return source(x + 16, y + 16, z); });
    const TestArea large(5, 5, source);
    const ChunkLight light = lightMiddle(small, scratch);
    constexpr int kHeight = kFilledHeight + 16;
    Reference reference(large, kHeight);
    for (int c = 0; c < kComponentCount; ++c) {
        const std::vector<int> expected = reference.solve(c);
        for (int i = 0; i < 256 * kHeight; ++i) {
            const int x = i & 15, y = i >> 4 & 15, z = i >> 8;
            ASSERT_EQ(levelOf(light.get(x, y, z), c), expected[large.index(x + 32, y + 32, z)])
                << "component " << c << " at " << x << ' ' << y << ' ' << z;
        }
    }
}

const std::uint32_t kWorlds = atDepth(1u, 3u);

TEST(LightChunk, EqualsTheReferenceOfALargerWorld) {
    LightScratch scratch;
    for (std::uint32_t seed = 20; seed < 20 + kWorlds; ++seed) {
        expectExact(caves(seed), scratch);
        expectExact(scattered(seed, 40), scratch);
        expectExact(scattered(seed, 3), scratch);
        expectExact(layers(seed), scratch);
        if (HasFailure()) return;
    }
}

// A tunnel one block wide from a lamp in the chunk at the corner, through the chunk beside it: stage 1 of
// neither knows of the other.
TEST(LightChunk, LightComesRoundTheCorner) {
    const auto stone = contentBlock("stone"), lamp = contentBlock("lamp_red");
    const TestArea area(3, 3, [&](int x, int y, int z) {
        if (z != 50) return stone;
        if (x == 13 && y == 13) return lamp;
        const bool along = y == 13 && x > 13 && x <= 18, up = x == 18 && y >= 13 && y < 30;
        return along || up ? world::kAir : stone;
    });
    LightScratch scratch;
    const ChunkLight light = lightMiddle(area, scratch);
    // 5 blocks along x to x = 18, then 3 along y into the chunk: 15 − 8.
    EXPECT_EQ(levelOf(light.get(2, 0, 50), kRed), 7);
    EXPECT_EQ(levelOf(light.get(2, 6, 50), kRed), 1);
    EXPECT_EQ(levelOf(light.get(2, 7, 50), kRed), 0);
}

// From the chunk out into its neighbor and back.
TEST(LightChunk, LightComesBackFromTheNeighbor) {
    const auto stone = contentBlock("stone"), lamp = contentBlock("lamp_blue");
    const TestArea area(3, 3, [&](int x, int y, int z) {
        if (z != 50) return stone;
        if (x == 17 && y == 20) return lamp;
        const bool out = y == 20 && x >= 14 && x < 17, side = x == 14 && y >= 20 && y <= 23,
                   back = y == 23 && x >= 14 && x <= 20;
        return out || side || back ? world::kAir : stone;
    });
    LightScratch scratch;
    const ChunkLight light = lightMiddle(area, scratch);
    EXPECT_EQ(levelOf(light.get(0, 4, 50), kBlue), 14);  // x = 16, on the way out
    EXPECT_EQ(levelOf(light.get(0, 7, 50), kBlue), 7);   // 3 out, 3 aside, 2 back: 15 − 8
    EXPECT_EQ(levelOf(light.get(4, 7, 50), kBlue), 3);
}

// The brick between them is one value of light at first, and the lamps' rows do not change.
TEST(LightChunk, LampsInCeilingAndFloorShineIntoAnEmptyBrick) {
    const auto stone = contentBlock("stone"), red = contentBlock("lamp_red"),
               blue = contentBlock("lamp_blue");
    const TestArea area(3, 3, [&](int x, int y, int z) {
        if (x == 24 && y == 24 && z == 64) return red;
        if (x == 24 && y == 24 && z == 47) return blue;
        return z >= 48 && z < 64 ? world::kAir : stone;
    });
    LightScratch scratch;
    const ChunkLight light = lightMiddle(area, scratch);
    EXPECT_EQ(light.get(8, 8, 63), 14);
    EXPECT_EQ(light.get(8, 8, 48), 14 << 8);
    EXPECT_EQ(light.get(8, 8, 60), 11 | 2 << 8);
    EXPECT_EQ(light.get(6, 8, 50), 10 << 8);
}

TEST(LightChunk, UnknownNeighborsAreDarkAndOpaque) {
    const auto stone = contentBlock("stone");
    const world::Chunk roofed =
        TestArea::makeChunk(0, 0, [&](int, int, int z) { return z == 99 ? stone : world::kAir; });
    LightScratch scratch;
    const LocalLight local = solveLocal(roofed, contentTable(), scratch),
                     open = solveLocal(world::Chunk(), contentTable(), scratch);
    LocalLightNeighborhood around{};
    around[kCenterChunk] = &local;
    EXPECT_EQ(lightChunk(around, scratch).get(0, 0, 50), kDark);
    around[3] = &open;  // −x
    EXPECT_EQ(lightChunk(around, scratch).get(0, 0, 50), 14 << 12);
    EXPECT_EQ(lightChunk(around, scratch).get(13, 0, 50), 1 << 12);
}

// As the streaming pipeline does it: each stage on any worker, results of stage 1 shared.
TEST(LightChunk, IsTheSameFromManyThreads) {
    const TestArea area(4, 4, caves(31));
    base::JobSystem jobs(4);
    std::vector<LocalLight> locals(area.chunks.size());
    const auto solved = base::parallelFor(jobs, locals.size(), [&](std::size_t k) {
        thread_local LightScratch scratch;
        locals[k] = solveLocal(area.chunks[k], contentTable(), scratch);
    });
    ASSERT_TRUE(solved);
    std::vector<ChunkLight> lights(area.chunks.size());
    const auto lit = base::parallelFor(jobs, lights.size(), [&](std::size_t k) {
        thread_local LightScratch scratch;
        LocalLightNeighborhood around{};
        for (int n = 0; n < kFieldChunks; ++n) {
            const int x = static_cast<int>(k) % 4 + n % 3 - 1, y = static_cast<int>(k) / 4 + n / 3 - 1;
            if (x < 0 || y < 0 || x >= 4 || y >= 4) continue;
            around[static_cast<std::size_t>(n)] = &locals[static_cast<std::size_t>(x + 4 * y)];
        }
        lights[k] = lightChunk(around, scratch);
    });
    ASSERT_TRUE(lit);
    EXPECT_TRUE(lights == area.lights());
}

// Stage 1 is shared between neighbors: stage 2 must leave it as it is.
TEST(LightChunk, LeavesTheFirstStageAlone) {
    const TestArea area(3, 3, caves(30));
    LightScratch scratch;
    std::vector<LocalLight> locals;
    for (const world::Chunk& chunk : area.chunks)
        locals.push_back(solveLocal(chunk, contentTable(), scratch));
    LocalLightNeighborhood around;
    for (std::size_t k = 0; k < around.size(); ++k) around[k] = &locals[k];
    const ChunkLight first = lightChunk(around, scratch);
    solveLocal(area.chunks[0], contentTable(), scratch);
    EXPECT_TRUE(first == lightChunk(around, scratch));
    EXPECT_TRUE(first == lightMiddle(area, scratch));
}

}  // namespace
}  // namespace terrane::light
