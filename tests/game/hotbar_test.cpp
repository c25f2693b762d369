#include "terrane/game/items.h"

#include <gtest/gtest.h>

#include "tests/world/content_blocks.h"

namespace terrane::game {
namespace {

TEST(Hotbar, BeginsWithNineDifferentBlocksThatCanBeBuilt) {
    const Hotbar hotbar = defaultHotbar(contentBlocks());
    for (std::size_t a = 0; a < Hotbar::kSlots; ++a) {
        EXPECT_TRUE(isBuildable(contentBlocks().type(hotbar.blocks[a]), contentBlocks())) << a;
        for (std::size_t b = 0; b < a; ++b) EXPECT_NE(hotbar.blocks[a], hotbar.blocks[b]) << a << ' ' << b;
    }
}

TEST(Hotbar, StepsGoAroundInACircle) {
    Hotbar hotbar = defaultHotbar(contentBlocks());
    cycleSlot(hotbar, -1);
    EXPECT_EQ(hotbar.selected, 8u);
    cycleSlot(hotbar, 2);
    EXPECT_EQ(hotbar.selected, 1u);
    cycleSlot(hotbar, -20);
    EXPECT_EQ(hotbar.selected, 8u);
}

TEST(Hotbar, ABlockIsTakenFromItsSlotOrIntoTheChosenOne) {
    Hotbar hotbar = defaultHotbar(contentBlocks());
    selectBlock(hotbar, hotbar.blocks[5]);
    EXPECT_EQ(hotbar.selected, 5u);
    selectBlock(hotbar, contentBlock("chest"));
    EXPECT_EQ(hotbar.selected, 5u);
    EXPECT_EQ(hotbar.block(), contentBlock("chest"));
}

TEST(Hotbar, TextReadsBackAsTheSame) {
    Hotbar hotbar = defaultHotbar(contentBlocks());
    selectBlock(hotbar, contentBlock("chest"));
    cycleSlot(hotbar, 3);
    hotbar.blocks[7] = world::kAir;
    EXPECT_EQ(parseHotbar(textOf(hotbar, contentBlocks()), contentBlocks()), hotbar);
}

TEST(Hotbar, AnyTextIsRead) {
    const Hotbar first = defaultHotbar(contentBlocks());
    for (const char* text : {"", "x", "9", "-1", "99999999999999999999 nothing", "0 missing oak_door_top"})
        EXPECT_EQ(parseHotbar(text, contentBlocks()), first) << text;
    EXPECT_EQ(parseHotbar("2 nothing chest", contentBlocks()).blocks[1], contentBlock("chest"));
    EXPECT_EQ(parseHotbar("2 nothing chest", contentBlocks()).selected, 2u);
}

}  // namespace
}  // namespace terrane::game
