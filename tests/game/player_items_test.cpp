#include "terrane/game/player_items.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "tests/world/content_blocks.h"

namespace terrane::game {
namespace {

class PlayerItemsTest : public testing::Test {
  protected:
    const world::BlockRegistry& blocks_ = contentBlocks();
    const world::ItemTable& table_ = blocks_.items();
};

std::map<std::string, int> sumOf(const PlayerItems& items) {
    std::map<std::string, int> sum;
    for (const world::ItemStack& stack : items.slots)
        if (stack.count > 0) sum[stack.item] += stack.count;
    return sum;
}

void putGrid(PlayerItems& items, int x, int y, const world::ItemStack& stack) {
    items.slots[kCarriedSlots + static_cast<std::size_t>(y * world::kMaxGridSide + x)] = stack;
}

TEST_F(PlayerItemsTest, TextsComeBack) {
    PlayerItems items;
    EXPECT_EQ(parsePlayerItems(textOf(items)).value(), items);
    items.mode = Mode::Survival;
    items.slots[0] = {"isles:amber", 99};
    items.slots[44] = {"iron_pick", 1, 249};
    EXPECT_EQ(textOf(items), "survival\n0 99 0 isles:amber\n44 1 249 iron_pick");
    EXPECT_EQ(parsePlayerItems(textOf(items)).value(), items);
}

TEST_F(PlayerItemsTest, OtherTextsAreRefused) {
    for (const char* text :
         {"", "hard", "world\n0 1 0", "world\n45 1 0 stone", "world\n0 0 0 stone", "world\n0 100 0 stone",
          "world\n0 1 0 stone\n0 1 0 sand", "world\n0 1 0 stone more", "world\n-1 1 0 stone",
          "world\n0 70000 0 stone", "world\n\n"})
        EXPECT_FALSE(parsePlayerItems(text)) << text;
}

TEST_F(PlayerItemsTest, ToolsDoNotShareASlot) {
    PlayerItems items;
    EXPECT_EQ(giveItems(items, table_, {"iron_pick", 3}), 0);
    EXPECT_EQ(items.slots[2], (world::ItemStack{"iron_pick", 1}));
    EXPECT_EQ(giveItems(items, table_, {"iron_pick", 40}), 7) << "33 slots are left, none of the grid";
    EXPECT_FALSE(hasRoom(items, table_, {"dirt", 1}));
}

TEST_F(PlayerItemsTest, CraftingTakesOneOfEachStack) {
    PlayerItems items;
    putGrid(items, 0, 0, {"coal", 5});
    putGrid(items, 0, 1, {"stick", 2});
    const world::Recipe* recipe = craft(items, table_, kHandGridSide);
    ASSERT_NE(recipe, nullptr);
    EXPECT_EQ(recipe->makes, "torch");
    EXPECT_EQ(sumOf(items), (std::map<std::string, int>{{"coal", 4}, {"stick", 1}, {"torch", 4}}));
    EXPECT_NE(craft(items, table_, kHandGridSide), nullptr);
    EXPECT_EQ(craft(items, table_, kHandGridSide), nullptr) << "the sticks are used up";
}

TEST_F(PlayerItemsTest, AToolNeedsTheGridOfAWorkbench) {
    PlayerItems items;
    for (int x = 0; x < 3; ++x) putGrid(items, x, 0, {"birch_planks", 1});
    putGrid(items, 1, 1, {"stick", 1});
    putGrid(items, 1, 2, {"stick", 1});
    EXPECT_EQ(craft(items, table_, kHandGridSide), nullptr);
    ASSERT_NE(craft(items, table_, world::kMaxGridSide), nullptr);
    EXPECT_EQ(sumOf(items), (std::map<std::string, int>{{"wooden_pick", 1}}));
}

TEST_F(PlayerItemsTest, CraftingWithoutRoomChangesNothing) {
    PlayerItems items;
    for (std::size_t slot = 0; slot < kCarriedSlots; ++slot) items.slots[slot] = {"dirt", 99};
    putGrid(items, 0, 0, {"oak_log", 3});
    const PlayerItems before = items;
    EXPECT_EQ(craft(items, table_, kHandGridSide), nullptr);
    EXPECT_EQ(items, before);
}

TEST_F(PlayerItemsTest, AWornOutToolIsGone) {
    PlayerItems items;
    items.slots[0] = {"wooden_axe", 1};
    const int uses = table_.find("wooden_axe")->tool.uses;
    for (int k = 1; k < uses; ++k) wearHand(items, table_);
    EXPECT_EQ(items.hand(), (world::ItemStack{"wooden_axe", 1, static_cast<std::uint16_t>(uses - 1)}));
    wearHand(items, table_);
    EXPECT_EQ(items.hand(), world::ItemStack{});
    items.slots[0] = {"dirt", 2};
    wearHand(items, table_);
    EXPECT_EQ(items.hand(), (world::ItemStack{"dirt", 2})) << "no tool";
}

// Every recipe of the program can be made.
TEST_F(PlayerItemsTest, EveryRecipeFitsItsOwnIngredients) {
    for (const world::Recipe& recipe : table_.recipes()) {
        PlayerItems items;
        const int width = recipe.width > 0 ? recipe.width : 3;
        for (std::size_t k = 0; k < recipe.ingredients.size(); ++k)
            if (!recipe.ingredients[k].empty())
                putGrid(items, static_cast<int>(k) % width, static_cast<int>(k) / width,
                        {recipe.ingredients[k].back(), 1});
        const world::Recipe* made = craft(items, table_, world::kMaxGridSide);
        ASSERT_NE(made, nullptr) << recipe.makes;
        EXPECT_EQ(made->makes, recipe.makes) << "another recipe takes the same items";
        EXPECT_EQ(sumOf(items), (std::map<std::string, int>{{recipe.makes, recipe.count}}));
    }
}

// Random moves, gifts, and takings: the sum of items changes by gifts and takings alone.
TEST_F(PlayerItemsTest, MovesKeepTheSumOfItems) {
    std::mt19937 random(5);
    const std::vector<std::string> names{"dirt", "stone", "iron_pick", "coal"};
    PlayerItems items;
    std::map<std::string, int> sum;
    for (int round = 0; round < 20'000; ++round) {
        const std::string& name = names[random() % names.size()];
        const int count = static_cast<int>(random() % 120);
        if (random() % 5 == 0) {
            sum[name] += count - giveItems(items, table_, {name, static_cast<std::uint16_t>(count)});
        } else if (random() % 5 == 0) {
            sum[name] -= world::takeItems(items.slots, name, count);
        } else {
            world::ItemStack& from = items.slots[random() % kPlayerSlots];
            world::ItemStack& to = items.slots[random() % kPlayerSlots];
            world::moveItems(from, to, count, table_.maxStackOf(from.item));
        }
        std::erase_if(sum, [](const auto& entry) { return entry.second == 0; });
        ASSERT_EQ(sumOf(items), sum);
        for (const world::ItemStack& stack : items.slots) {
            ASSERT_EQ(stack.count == 0, stack.item.empty());
            ASSERT_LE(stack.count, table_.maxStackOf(stack.item));
        }
    }
}

}  // namespace
}  // namespace terrane::game
