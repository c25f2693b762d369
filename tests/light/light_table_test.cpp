#include "terrane/light/light_sources.h"

#include <gtest/gtest.h>

#include "tests/world/content_blocks.h"

namespace terrane::light {
namespace {

TEST(LightTable, HoldsOpacityInAllComponents) {
    const LightTable table(contentBlocks());
    EXPECT_EQ(table.opacity(world::kAir), 0);
    EXPECT_EQ(table.opacity(contentBlock("stone")), 0xFFFF);
    EXPECT_EQ(table.opacity(contentBlock("oak_leaves")), 0x3333);
    EXPECT_EQ(table.opacity(contentBlock("cactus")), 0xBBBB);
}

TEST(LightTable, HoldsEmissionWithoutDaylight) {
    const LightTable table(contentBlocks());
    EXPECT_EQ(table.emission(contentBlock("stone")), 0);
    EXPECT_EQ(table.emission(contentBlock("lamp_white")), 15 | 13 << 4 | 13 << 8);
    EXPECT_EQ(table.emission(contentBlock("glowing_ore")), 2 | 1 << 4);
}

TEST(LightTable, UnknownBlocksAreLikeMissing) {
    const LightTable table(contentBlocks());
    EXPECT_EQ(table.opacity(60000), table.opacity(contentBlocks().missing()));
    EXPECT_EQ(table.emission(60000), table.emission(contentBlocks().missing()));
}

TEST(LightValue, KeepsFourLevels) {
    const LightValue value = withLevel(withLevel(kFullDaylight, kRed, 3), kBlue, 9);
    EXPECT_EQ(value, 0xF903);
    EXPECT_EQ(levelOf(value, kRed), 3);
    EXPECT_EQ(levelOf(value, kGreen), 0);
    EXPECT_EQ(levelOf(value, kBlue), 9);
    EXPECT_EQ(levelOf(value, kDaylight), 15);
    EXPECT_EQ(withLevel(value, kDaylight, 0), 0x0903);
    EXPECT_EQ(allComponents(11), 0xBBBB);
}

}  // namespace
}  // namespace terrane::light
