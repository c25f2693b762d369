#include "terrane/game/items.h"

#include <gtest/gtest.h>

#include "tests/world/content_blocks.h"

namespace terrane::game {
namespace {

TEST(Hotbar, BeginsWithNineDifferentBlocksThatCanBeBuilt) {
    const Hotbar hotbar = firstHotbar(contentBlocks());
    for (std::size_t a = 0; a < Hotbar::kSlots; ++a) {
        EXPECT_TRUE(isBuilt(contentBlocks().type(hotbar.blocks[a]), contentBlocks())) << a;
        for (std::size_t b = 0; b < a; ++b) EXPECT_NE(hotbar.blocks[a], hotbar.blocks[b]) << a << ' ' << b;
    }
}

TEST(Hotbar, StepsGoAroundInACircle) {
    Hotbar hotbar = firstHotbar(contentBlocks());
    stepSlot(hotbar, -1);
    EXPECT_EQ(hotbar.chosen, 8u);
    stepSlot(hotbar, 2);
    EXPECT_EQ(hotbar.chosen, 1u);
    stepSlot(hotbar, -20);
    EXPECT_EQ(hotbar.chosen, 8u);
}

TEST(Hotbar, ABlockIsTakenFromItsSlotOrIntoTheChosenOne) {
    Hotbar hotbar = firstHotbar(contentBlocks());
    takeInHand(hotbar, hotbar.blocks[5]);
    EXPECT_EQ(hotbar.chosen, 5u);
    takeInHand(hotbar, contentBlock("chest"));
    EXPECT_EQ(hotbar.chosen, 5u);
    EXPECT_EQ(hotbar.block(), contentBlock("chest"));
}

TEST(Hotbar, TextReadsBackAsTheSame) {
    Hotbar hotbar = firstHotbar(contentBlocks());
    takeInHand(hotbar, contentBlock("chest"));
    stepSlot(hotbar, 3);
    hotbar.blocks[7] = world::kAir;
    EXPECT_EQ(hotbarFrom(textOf(hotbar, contentBlocks()), contentBlocks()), hotbar);
}

TEST(Hotbar, AnyTextIsRead) {
    const Hotbar first = firstHotbar(contentBlocks());
    for (const char* text : {"", "x", "9", "-1", "99999999999999999999 nothing", "0 missing oak_door_top"})
        EXPECT_EQ(hotbarFrom(text, contentBlocks()), first) << text;
    EXPECT_EQ(hotbarFrom("2 nothing chest", contentBlocks()).blocks[1], contentBlock("chest"));
    EXPECT_EQ(hotbarFrom("2 nothing chest", contentBlocks()).chosen, 2u);
}

}  // namespace
}  // namespace terrane::game
