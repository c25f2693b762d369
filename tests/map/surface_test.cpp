#include "terrane/map/surface.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/map/map_fixture.h"
#include "tests/support/default_heights.h"

namespace terrane::map {
namespace {

using world::BlockId;

// Ids beyond the end are ground.
const SurfaceKinds kSomeKinds = {SurfaceKind::Nothing, SurfaceKind::Ground, SurfaceKind::Liquid,
                                 SurfaceKind::Crown, SurfaceKind::Nothing};
constexpr BlockId kLiquidBlock = 2, kCrownBlock = 3, kPlantBlock = 4, kUnknownBlock = 900;

SurfaceColumn columnByBlocks(const world::Chunk& chunk, int x, int y) {
    SurfaceColumn column;
    std::pair<BlockId, int> ground, groundOrLiquid;
    for (int z = 0; z < world::kChunkHeight; ++z) {
        const BlockId block = chunk.block(world::blockIndex(x, y, z));
        const SurfaceKind kind = block < kSomeKinds.size() ? kSomeKinds[block] : SurfaceKind::Ground;
        if (kind == SurfaceKind::Nothing) continue;
        column.top = block;
        column.topZ = static_cast<std::int16_t>(z);
        if (kind == SurfaceKind::Ground) ground = {block, z};
        if (kind == SurfaceKind::Ground || kind == SurfaceKind::Liquid) groundOrLiquid = {block, z};
    }
    const bool isCrown = column.top == kCrownBlock;
    std::tie(column.under, column.underZ) = isCrown ? groundOrLiquid : ground;
    return column;
}

// One of a few choices of blocks a section, so that columns go deep: all forms of sections come up.
world::Section randomSectionOf(std::mt19937& random) {
    const std::vector<std::vector<BlockId>> choices = {
        {0},          {kPlantBlock}, {0, kPlantBlock},     {2}, {0, 2, kPlantBlock}, {0, 3},
        {0, 0, 0, 1}, {0, 2, 3, 4},  {kUnknownBlock, 0, 2}};
    const std::vector<BlockId>& blocks = choices[random() % choices.size()];
    std::array<BlockId, world::kBlocksPerSection> values;
    for (BlockId& value : values) {
        value = blocks[random() % blocks.size()];
        if (value == 0 && random() % 200 == 0) value = 1;
    }
    return world::Section::fromValues(values);
}

TEST(Surface, IsWhatOneSeesColumnByColumn) {
    std::mt19937 random(1);
    for (int round = 0; round < 60; ++round) {
        world::Chunk chunk;
        for (int s = 0; s < world::kSectionsPerChunk; ++s)
            if (random() % 3 > 0) chunk.setSection(s, randomSectionOf(random));
        const Surface surface = surfaceOf(chunk, kSomeKinds);
        for (int y = 0; y < world::kChunkSize; ++y)
            for (int x = 0; x < world::kChunkSize; ++x)
                ASSERT_EQ(surface[static_cast<std::size_t>(x + 16 * y)], columnByBlocks(chunk, x, y))
                    << "round " << round << " at " << x << ", " << y;
    }
}

TEST(Surface, DenseSectionsCount) {
    std::array<BlockId, world::kBlocksPerSection> values;
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = static_cast<BlockId>(1000 + k);
    world::Chunk chunk;
    chunk.setSection(3, world::Section::fromValues(values));
    ASSERT_TRUE(chunk.section(3).isDense());
    const Surface surface = surfaceOf(chunk, kSomeKinds);
    EXPECT_EQ(surface[17], (SurfaceColumn{1000 + 15 * 256 + 17, 1000 + 15 * 256 + 17, 63, 63}));
}

TEST(Surface, ThereMayBeNothing) {
    EXPECT_EQ(surfaceOf(world::Chunk(), kSomeKinds)[0], SurfaceColumn());
    world::Chunk plants;
    plants.setSection(5, world::Section(kPlantBlock));
    EXPECT_EQ(surfaceOf(plants, kSomeKinds)[255], SurfaceColumn());
}

TEST(Surface, LowestAndHighestBlocksCount) {
    world::Chunk chunk;
    chunk.setBlock(world::blockIndex(4, 2, 0), 1);
    chunk.setBlock(world::blockIndex(4, 2, 255), 2);
    EXPECT_EQ(surfaceOf(chunk, kSomeKinds)[4 + 16 * 2], (SurfaceColumn{2, 1, 255, 0}));
}

SurfaceKind kindNamed(std::string_view name) {
    return contentKinds()[contentBlock(name)];
}

TEST(Surface, KindsOfTheBlocksThatComeWithTheProgram) {
    EXPECT_EQ(contentKinds()[world::kAir], SurfaceKind::Nothing);
    EXPECT_EQ(kindNamed("stone"), SurfaceKind::Ground);
    EXPECT_EQ(kindNamed("water"), SurfaceKind::Liquid);
    EXPECT_EQ(kindNamed("grass"), SurfaceKind::Ground);
    EXPECT_EQ(kindNamed("glowing_mushroom"), SurfaceKind::Crown) << "it is seen at night";
    EXPECT_EQ(kindNamed("crystal"), SurfaceKind::Crown);
    for (const world::BlockType& type : contentBlocks().types()) {
        if (type.name.ends_with("leaves")) {
            EXPECT_EQ(contentKinds()[type.id], SurfaceKind::Crown) << type.name;
        }
        if (type.shape == world::Shape::Cross) {
            const bool shines = type.emission[0] + type.emission[1] + type.emission[2] > 0;
            EXPECT_EQ(contentKinds()[type.id], shines ? SurfaceKind::Crown : SurfaceKind::Nothing)
                << type.name;
        }
    }
}

TEST(Surface, UnderACrownIsGroundOrLiquid) {
    world::Chunk chunk;
    const auto stack = [&](int x, std::initializer_list<std::pair<int, BlockId>> blocks) {
        for (const auto& [z, block] : blocks) chunk.setBlock(world::blockIndex(x, 0, z), block);
    };
    stack(0, {{10, 1}, {20, kLiquidBlock}, {30, kCrownBlock}});
    stack(1, {{10, 1},
              {20, kLiquidBlock},
              {21, kLiquidBlock},
              {30, kCrownBlock},
              {31, kCrownBlock},
              {32, kPlantBlock}});
    stack(2, {{10, 1}, {20, kCrownBlock}, {30, kLiquidBlock}});
    stack(3, {{10, 1}, {20, kCrownBlock}});
    stack(4, {{20, kLiquidBlock}, {30, kCrownBlock}});
    stack(5, {{20, kCrownBlock}});
    const Surface surface = surfaceOf(chunk, kSomeKinds);
    EXPECT_EQ(surface[0], (SurfaceColumn{kCrownBlock, kLiquidBlock, 30, 20}));
    EXPECT_EQ(surface[1], (SurfaceColumn{kCrownBlock, kLiquidBlock, 31, 21}));
    EXPECT_EQ(surface[2], (SurfaceColumn{kLiquidBlock, 1, 30, 10})) << "under a liquid, ground alone";
    EXPECT_EQ(surface[3], (SurfaceColumn{kCrownBlock, 1, 20, 10}));
    EXPECT_EQ(surface[4], (SurfaceColumn{kCrownBlock, kLiquidBlock, 30, 20}));
    EXPECT_EQ(surface[5], (SurfaceColumn{kCrownBlock, world::kAir, 20, 0}));
}

}  // namespace
}  // namespace terrane::map
