#include "terrane/game/items.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/world/content_blocks.h"
#include "tests/world/put_block.h"

namespace terrane::game {
namespace {

class ContainerTest : public testing::Test {
  protected:
    ContainerTest() {
        world_.insert({0, 0}, std::make_shared<world::Chunk>());
        world::putBlock(world_, kChest, id("chest"));
        world::putBlock(world_, kStone, id("stone"));
    }
    world::BlockId id(const char* name) const { return blocks_.find(name)->id; }

    static constexpr world::BlockPos kChest{3, 4, 50}, kStone{4, 4, 50}, kFar{100, 4, 50};
    const world::BlockRegistry& blocks_ = contentBlocks();
    world::World world_;
};

TEST_F(ContainerTest, OnlyBlocksWithSlotsOpen) {
    EXPECT_TRUE(isContainer(world_, blocks_, kChest));
    EXPECT_FALSE(isContainer(world_, blocks_, kStone));
    EXPECT_FALSE(isContainer(world_, blocks_, kFar));
}

TEST_F(ContainerTest, IsEmptyUntilSomethingIsPut) {
    EXPECT_EQ(itemsOf(world_, blocks_, kChest).value(), world::Inventory(27));
}

TEST_F(ContainerTest, ClicksPutAndTake) {
    world::Inventory items(27);
    world::BlockId hand = world::kAir;
    EXPECT_FALSE(clickSlot(items, blocks_, {.slot = 26}, hand)) << "an empty hand puts nothing";
    EXPECT_EQ(items, world::Inventory(27));
    hand = id("sand");
    EXPECT_TRUE(clickSlot(items, blocks_, {.slot = 26}, hand));
    EXPECT_TRUE(clickSlot(items, blocks_, {.slot = 26}, hand));
    EXPECT_EQ(items[26], (world::ItemStack{"sand", 2}));
    EXPECT_TRUE(clickSlot(items, blocks_, {.slot = 26, .wholeStack = true}, hand));
    EXPECT_EQ(items[26].count, world::kMaxStack);
    EXPECT_FALSE(clickSlot(items, blocks_, {.slot = 26}, hand)) << "full";

    hand = id("stone");
    EXPECT_FALSE(clickSlot(items, blocks_, {.slot = 26}, hand)) << "there is sand";
    EXPECT_FALSE(clickSlot(items, blocks_, {.slot = 0, .takes = true}, hand)) << "there is nothing";
    EXPECT_EQ(hand, id("stone"));
    EXPECT_TRUE(clickSlot(items, blocks_, {.slot = 26, .takes = true}, hand));
    EXPECT_EQ(hand, id("sand")) << "what is taken is in the hand";
    EXPECT_EQ(items[26].count, world::kMaxStack - 1);
    EXPECT_TRUE(clickSlot(items, blocks_, {.slot = 26, .takes = true, .wholeStack = true}, hand));
    EXPECT_EQ(items, world::Inventory(27));
}

TEST_F(ContainerTest, ItemsOfOtherProgramsStay) {
    world::Inventory items(27);
    world::addItems(items, "philosophers_stone", 3);
    const world::Inventory before = items;
    world::BlockId hand = id("stone");
    EXPECT_FALSE(clickSlot(items, blocks_, {.slot = 0, .takes = true}, hand));
    EXPECT_FALSE(clickSlot(items, blocks_, {.slot = 0}, hand));
    EXPECT_EQ(items, before);
}

TEST_F(ContainerTest, DataThatIsNoInventoryIsNamed) {
    std::vector<world::BlockEdit> edits;
    world::applyChange(world_, blocks_, kChest, world::SetEntityData{{std::byte{7}}}, edits);
    const auto items = itemsOf(world_, blocks_, kChest);
    ASSERT_FALSE(items);
    EXPECT_EQ(items.error().message, "the chest at 3,4,50: not an inventory of version 1 or 2");
}

TEST_F(ContainerTest, TakesInventoriesWithItsSlotsAlone) {
    const auto may = [&](const world::Inventory& items, world::BlockPos pos = kChest) {
        return maySetItems(world_, blocks_, pos, world::encodeInventory(items));
    };
    world::Inventory hidden(301);
    hidden[300] = {"stone", 1};
    EXPECT_TRUE(may(world::Inventory(27)));
    EXPECT_TRUE(maySetItems(world_, blocks_, kChest, {})) << "nothing";
    EXPECT_FALSE(may(hidden));
    EXPECT_FALSE(may(world::Inventory(26)));
    EXPECT_FALSE(maySetItems(world_, blocks_, kChest, world::BlockEntityData(9)));
    EXPECT_TRUE(may(hidden, kStone)) << "not its subject";
}

// From a save of version 0.2 or older.
TEST_F(ContainerTest, WithTooManySlotsCanBeEmptied) {
    world::Inventory old(301);
    for (std::size_t slot = 0; slot < 29; ++slot) old[slot] = {"sand", 1};
    old[300] = {"stone", 2};
    std::vector<world::BlockEdit> edits;
    world::applyChange(world_, blocks_, kChest, world::SetEntityData{world::encodeInventory(old)}, edits);
    world::BlockId hand = world::kAir;
    std::size_t clicks = 0;
    for (auto items = itemsOf(world_, blocks_, kChest).value(); clicks < 40; ++clicks) {
        EXPECT_LE(items.size(), 30u);
        const auto full = std::ranges::find_if(items, [](const world::ItemStack& s) { return s.count > 0; });
        if (full == items.end()) break;
        const auto slot = static_cast<std::size_t>(full - items.begin());
        ASSERT_TRUE(clickSlot(items, blocks_, {.slot = slot, .takes = true, .wholeStack = true}, hand));
        const world::BlockEntityData data = world::encodeInventory(items);
        ASSERT_TRUE(maySetItems(world_, blocks_, kChest, data));
        world::applyChange(world_, blocks_, kChest, world::SetEntityData{data}, edits);
        items = itemsOf(world_, blocks_, kChest).value();
    }
    EXPECT_EQ(clicks, 30u);
    EXPECT_EQ(itemsOf(world_, blocks_, kChest).value(), world::Inventory(27));
}

TEST_F(ContainerTest, AClickBesideTheSlotsChangesNothing) {
    world::Inventory items(27);
    world::BlockId hand = id("sand");
    EXPECT_FALSE(clickSlot(items, blocks_, {.slot = 27}, hand));
    EXPECT_FALSE(clickSlot(items, blocks_, {.slot = SIZE_MAX, .takes = true}, hand));
    EXPECT_EQ(items, world::Inventory(27));
    EXPECT_EQ(hand, id("sand"));
}

}  // namespace
}  // namespace terrane::game
