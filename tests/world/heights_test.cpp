#include "terrane/world/heights.h"

#include <gmock/gmock.h>

#include <vector>

#include "terrane/world/changes/liquid_flow.h"
#include "terrane/world/character.h"
#include "terrane/world/ray_cast.h"
#include "tests/world/flow_world.h"

namespace terrane::world {
namespace {

TEST(Heights, AreMultiplesOfSixteenWithinTheLimits) {
    for (const Heights heights : {Heights{}, Heights{-64, 320}, Heights{kLowestBottom, kHighestTop},
                                  Heights{-2048, -2032}, Heights{2032, 2048}, Heights{512, 1024}}) {
        EXPECT_TRUE(isValid(heights)) << describe(heights);
        EXPECT_TRUE(checkHeights(heights));
    }
    for (const Heights heights : {Heights{0, 0}, Heights{16, 0}, Heights{-2064, 0}, Heights{0, 2064},
                                  Heights{-1, 256}, Heights{0, 255}, Heights{8, 24}}) {
        EXPECT_FALSE(isValid(heights)) << describe(heights);
        EXPECT_FALSE(checkHeights(heights));
    }
    EXPECT_THAT(checkHeights({-8, 256}).error().message, testing::HasSubstr("-8 and 256"));
}

TEST(Heights, CountLayersAndSections) {
    constexpr Heights kTall{-64, 320};
    EXPECT_EQ(kTall.layers(), 384);
    EXPECT_EQ(kTall.sections(), 24);
    EXPECT_EQ(kTall.firstSection(), -4);
    EXPECT_EQ(kTall.endSection(), 20);
    EXPECT_TRUE(kTall.contains(-64) && kTall.contains(319));
    EXPECT_FALSE(kTall.contains(-65) || kTall.contains(320));
    EXPECT_EQ(kTall.clamp(-1000), -64);
    EXPECT_EQ(kTall.clamp(1000), 319);
    EXPECT_EQ(kTall.clamp(7), 7);
    EXPECT_EQ(describe(kTall), "-64 to 319");
}

TEST(SectionSet, HoldsNumbersOfAllWorlds) {
    SectionSet set;
    EXPECT_TRUE(set.isEmpty());
    for (const int number : {-128, -1, 0, 63, 64, 127}) set.add(number);
    std::vector<int> numbers;
    set.forEach([&](int number) { numbers.push_back(number); });
    EXPECT_EQ(numbers, (std::vector{-128, -1, 0, 63, 64, 127}));
    EXPECT_EQ(set.count(), 6u);
    EXPECT_TRUE(set.has(-1));
    EXPECT_FALSE(set.has(1));
    SectionSet other = SectionSet::all({-16, 32});
    EXPECT_EQ(other.count(), 3u);
    other |= set;
    EXPECT_EQ(other.count(), 7u);
    EXPECT_EQ(SectionSet::all({kLowestBottom, kHighestTop}).count(), 256u);
}

TEST(TallWorld, TakesChunksOfItsHeightsOnly) {
    World world({-64, 320});
    world.insert({0, 0}, std::make_shared<Chunk>(Heights{-64, 320}));
    EXPECT_THROW(world.insert({0, 0}, std::make_shared<Chunk>()), std::invalid_argument);
    EXPECT_EQ(world.block({0, 0, -65}), kAir);
    EXPECT_EQ(world.block({0, 0, 320}), kAir);
}

// A fall of 1,000 blocks reaches its floor, and spreads there as one of ten blocks does.
TEST(TallWorld, WaterFallsAThousandBlocks) {
    const auto spread = [](Heights heights, int source) {
        FlowWorld flow(heights);
        flow.addChunks(-1, -1, 1, 1);
        flow.set({8, 8, source}, "water");
        flow.settle(3000, 1);
        std::vector<std::string> rows;
        for (int y = 0; y < 16; ++y) rows.push_back(flow.row(0, 15, y, heights.bottom + 1));
        EXPECT_EQ(flow.at({8, 8, source - 1}), 'f');
        return rows;
    };
    const auto high = spread({-512, 512}, 490);
    EXPECT_EQ(high, spread({}, 11));
    EXPECT_NE(high[8].find('f'), std::string::npos);
}

TEST(TallWorld, RaysReachItsEnds) {
    FlowWorld tall({kLowestBottom, kHighestTop});
    tall.addChunks(0, 0, 0, 0);
    tall.set({4, 4, kHighestTop - 1}, "stone");
    const auto down = castRay(tall.world, contentBlocks(), {{4.5, 4.5, 2040}, {0, 0, -1}}, 5000);
    ASSERT_TRUE(down);
    EXPECT_EQ(down->block, (BlockPos{4, 4, kLowestBottom}));
    const auto up = castRay(tall.world, contentBlocks(), {{4.5, 4.5, -2000}, {0, 0, 1}}, 5000);
    ASSERT_TRUE(up);
    EXPECT_EQ(up->block, (BlockPos{4, 4, kHighestTop - 1}));
    EXPECT_TRUE(castRay(tall.world, contentBlocks(), {{4.5, 4.5, 3000}, {0, 0, -1}}, 5000)) << "from above";
}

// Down a shaft of one block, at full speed: nothing stops the fall before the floor.
TEST(TallWorld, APlayerFallsTwoThousandBlocks) {
    constexpr Heights kHeights{-1024, 1024};
    FlowWorld tall(kHeights);
    tall.addChunks(-1, -1, 1, 1);
    auto rock = std::make_shared<Chunk>(kHeights);
    for (int number = kHeights.firstSection(); number < kHeights.endSection(); ++number) {
        Section section(contentBlock("stone"));
        for (int z = 0; z < kSectionSize; ++z) section.set(blockIndex(8, 8, z), kAir);
        rock->setSection(number, section);
    }
    rock->setBlock(blockIndex(8, 8, kHeights.bottom), contentBlock("stone"));
    tall.world.insert({0, 0}, std::move(rock));
    Character player{.feet = {8.5, 8.5, 1000}};
    double fastest = 0;
    for (int step = 0; step < 20000 && !player.isOnGround; ++step) {
        const Character next = advanceCharacter(tall.world, contentBlocks(), player, {.hasGravity = true});
        ASSERT_LT(next.feet.z, player.feet.z) << "step " << step;
        player = next;
        fastest = std::min(fastest, player.velocity.z);
    }
    EXPECT_EQ(fastest, -kFallLimit);
    EXPECT_NEAR(player.feet.z, kHeights.bottom + 1, 0.01);
}

}  // namespace
}  // namespace terrane::world
