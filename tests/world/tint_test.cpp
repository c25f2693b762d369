#include "terrane/world/tint.h"

#include <gtest/gtest.h>

#include "terrane/world/map_image.h"
#include "tests/world/content_blocks.h"

namespace terrane::world {
namespace {

glm::vec3 colorOf(PackedColor color) {
    return glm::vec3(color >> 16 & 255u, color >> 8 & 255u, color & 255u) / 255.0f;
}

void expectNear(glm::vec3 a, glm::vec3 b, float tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << "channel " << c;
}

TEST(Tint, NeutralBecomesTheTint) {
    for (const PackedColor tint : {packColor(200, 40, 130), packColor(60, 180, 50), kNeutralTint}) {
        expectNear(tinted(colorOf(kNeutralTint), tint), colorOf(tint), 1e-3f);
        expectNear(tinted(glm::vec3(1), tint), glm::vec3(1), 1e-6f);
        expectNear(tinted(glm::vec3(0), tint), glm::vec3(0), 0.01f);
    }
    expectNear(tinted({0.3f, 0.6f, 0.9f}, kNeutralTint), {0.3f, 0.6f, 0.9f}, 1e-6f);
    EXPECT_GE(tinted(glm::vec3(0.5f), 0).r, 0.0f) << "a black tint is a number";
}

// Flat grass, a chunk of it tinted, and stone.
TEST(Tint, MapsShowIt) {
    const auto mapOf = [](std::string_view name, PackedColor tint) {
        Chunk chunk;
        for (int k = 0; k < kChunkSize * kChunkSize; ++k)
            chunk.setBlock(blockIndex(k % 16, k / 16, 70), contentBlock(name));
        MapSource source{{0, 0, 1, 1}, 0, [&](std::span<const ChunkPos> row) {
                             return base::Result<std::vector<Chunk>>(std::vector<Chunk>(row.size(), chunk));
                         }};
        source.tint = [=](ChunkPos) {
            TintTile tile;
            tile.fill(tint);
            return tile;
        };
        const TextureSource textures = [](std::string_view) -> base::Result<base::Image> {
            return base::Image{1, 1, {95, 135, 50, 255}};
        };
        base::JobSystem jobs(1);
        const base::Image image =
            drawMap(source, contentBlocks(), textures, jobs, [](std::size_t) {}).value();
        return glm::ivec3(image.rgba[400], image.rgba[401], image.rgba[402]);
    };
    const glm::ivec3 plain = mapOf("grass", kNeutralTint), dry = mapOf("grass", packColor(190, 135, 50));
    EXPECT_NEAR(dry.r, 2 * plain.r, 2);
    EXPECT_NEAR(dry.g, plain.g, 1);
    EXPECT_EQ(mapOf("stone", packColor(190, 135, 50)), mapOf("stone", kNeutralTint));
}

}  // namespace
}  // namespace terrane::world
