// areas.cpp, against the light of a whole area at once.
#include "terrane/light/light_area.h"
#include "terrane/volume/areas.h"
#include "tests/volume/volume_fixture.h"

namespace terrane::volume {
namespace {

std::vector<LightLevels> lightOf(OpenedWorld& world, const BlockArea& area) {
    std::vector<LightLevels> levels(static_cast<std::size_t>(area.blockCount()), LightLevels{99, 99, 99, 99});
    const auto read = readLight(world, area, levels, {});
    EXPECT_TRUE(read) << read.error().message;
    return levels;
}

// The chunks of an area and those around it.
struct Surroundings {
    world::ChunkArea area;
    std::vector<world::Chunk> chunks;
    std::vector<light::ChunkLight> lights;

    LightLevels at(std::int64_t x, std::int64_t y, std::int64_t z) const {
        const std::int64_t number = (x >> 4) - area.x0 + ((y >> 4) - area.y0) * (area.x1 - area.x0);
        return lightLevels(lights[static_cast<std::size_t>(number)].get(
            static_cast<int>(x & 15), static_cast<int>(y & 15), static_cast<int>(z)));
    }
};

Surroundings around(OpenedWorld& world, const BlockArea& blocks) {
    const world::ChunkArea inner = chunksOver(blocks);
    Surroundings around{{inner.x0 - 1, inner.y0 - 1, inner.x1 + 1, inner.y1 + 1}, {}, {}};
    light::LightArea area{around.area.x1 - around.area.x0, around.area.y1 - around.area.y0, {}};
    for (std::int64_t k = 0; k < around.area.chunkCount(); ++k) {
        const world::ChunkPos pos = chunkIn(around.area, k);
        const store::LoadedChunk stored = world.store().load(pos);
        around.chunks.push_back(stored.chunk ? *stored.chunk : (*world.generator(0))->generate(pos));
    }
    for (const world::Chunk& chunk : around.chunks) area.chunks.push_back(&chunk);
    around.lights = light::lightArea(area, world.lights());
    return around;
}

void expectLight(OpenedWorld& world, const BlockArea& area) {
    const auto levels = lightOf(world, area);
    const Surroundings reference = around(world, area);
    int wrong = 0;
    forEachBlock(area, [&](auto x, auto y, auto z, std::size_t place) {
        wrong += levels[place] != reference.at(x, y, z);
    });
    EXPECT_EQ(wrong, 0) << area.x0 << "," << area.y0;
}

TEST(ReadLight, AreasAreLitAsAWholeWorldIs) {
    const auto world = openWorld("overworld");
    std::mt19937 random(3);
    for (int k = 0; k < 6; ++k) expectLight(*world, randomArea(random));
}

TEST(ReadLight, LampsAndSquaresMeet) {
    const auto world = openWorld("flat");
    // Lamps under a roof, some beside the border of the square that is lit at once.
    const world::BlockId stone = contentBlock("stone"), lamp = contentBlock("lamp_white");
    ASSERT_TRUE(writeArea(*world, {200, 0, 100, 300, 20, 101}, {std::span(&stone, 1)}, {}));
    for (const std::int64_t x : {203, 250, 255, 256, 260})
        ASSERT_TRUE(writeArea(*world, {x, 7, 90, x + 1, 8, 91}, {std::span(&lamp, 1)}, {}));
    expectLight(*world, {1, 0, 85, 275, 17, 105});
}

TEST(ReadLight, ChannelsAreSunRedGreenBlue) {
    EXPECT_EQ(lightLevels(0xF321), (LightLevels{15, 1, 2, 3}));
    const auto world = openWorld("flat");
    EXPECT_EQ(lightOf(*world, {0, 0, 200, 1, 1, 201}).front(), (LightLevels{15, 0, 0, 0}));
    EXPECT_EQ(lightOf(*world, {0, 0, 10, 1, 1, 11}).front(), (LightLevels{0, 0, 0, 0}));
}

TEST(ReadLight, TheCornerOfTheWorldIsLit) {
    const auto world = openWorld("flat");
    constexpr std::int64_t kEnd = std::int64_t{1} << 31;
    const auto levels = lightOf(*world, {kEnd - 1, kEnd - 1, 200, kEnd, kEnd, 201});
    EXPECT_EQ(levels.front()[kSun], 15);
}

}  // namespace
}  // namespace terrane::volume
