#include "apps/terrane/window/chest.h"

#include <gtest/gtest.h>

#include "apps/terrane/content.h"

namespace terrane::app {
namespace {

class ChestTest : public testing::Test {
  protected:
    ChestTest() {
        world_.insert({0, 0}, std::make_shared<world::Chunk>());
        world_.setBlock(kChest, id("chest"));
        world_.setBlock(kStone, id("stone"));
    }
    world::BlockId id(const char* name) const { return blocks_.find(name)->id; }

    static constexpr world::BlockPos kChest{3, 4, 50}, kStone{4, 4, 50}, kFar{100, 4, 50};
    world::BlockRegistry blocks_ = loadBlocks().value();
    world::World world_;
};

TEST_F(ChestTest, OnlyBlocksWithSlotsOpen) {
    EXPECT_TRUE(isChest(world_, blocks_, kChest));
    EXPECT_FALSE(isChest(world_, blocks_, kStone));
    EXPECT_FALSE(isChest(world_, blocks_, kFar));
}

TEST_F(ChestTest, IsEmptyUntilSomethingIsPut) {
    EXPECT_EQ(itemsOf(world_, blocks_, kChest).value(), world::Inventory(27));
}

TEST_F(ChestTest, ClicksPutAndTake) {
    world::Inventory items(27);
    world::BlockId hand = id("sand");
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

TEST_F(ChestTest, ItemsOfOtherProgramsStay) {
    world::Inventory items(27);
    world::addItems(items, "philosophers_stone", 3);
    const world::Inventory before = items;
    world::BlockId hand = id("stone");
    EXPECT_FALSE(clickSlot(items, blocks_, {.slot = 0, .takes = true}, hand));
    EXPECT_FALSE(clickSlot(items, blocks_, {.slot = 0}, hand));
    EXPECT_EQ(items, before);
}

TEST_F(ChestTest, DataThatIsNoInventoryIsNamed) {
    world_.setLargeData(kChest, {std::byte{7}});
    const auto items = itemsOf(world_, blocks_, kChest);
    ASSERT_FALSE(items);
    EXPECT_EQ(items.error().message, "the chest at 3,4,50: not an inventory of version 1");
}

}  // namespace
}  // namespace terrane::app
