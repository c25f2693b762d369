#include "terrane/world/items/item_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "terrane/world/blocks/block_parser.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::world {
namespace {

using testing::HasSubstr;

constexpr std::string_view kBlocks = R"(
[[block]]
name = "stone"
shape = "cube"
texture = "stone"
drops = "cobble"

[[block]]
name = "cobble"
like = "stone"
texture = "cobble"

[[block]]
name = "iron_ore"
like = "stone"
texture = "iron_ore"
tool_level = 2

[[block]]
name = "log"
shape = "cube"
texture = "log"
sound = "wood"

[[block]]
name = "flower"
shape = "cross"
texture = "flower"
opacity = 0
drops = { item = "stick", count = 3 }
)";

constexpr std::string_view kItems = R"(
[sets]
hard = ["cobble", "stone"]

[[item]]
name = "stick"

[[item]]
name = "pick"
tool = "pick"
level = 1
speed = 3
uses = 50

[[recipe]]
makes = "pick"
shape = ["###", " / ", " / "]
keys = { "#" = "hard", "/" = "stick" }

[[recipe]]
makes = "stick"
count = 4
of = ["log", ["flower", "stick"]]

[[recipe]]
makes = "log"
shape = ["//", "/ "]
keys = { "/" = "stick" }
)";

std::shared_ptr<const BlockRegistry> registryOf(std::string_view items) {
    auto file = parseBlocks(kBlocks, "blocks.toml").value();
    const ItemFile read = parseItems(items, "items.toml").value();
    return std::make_shared<const BlockRegistry>(
        BlockRegistry::fromDescriptions(std::move(file.blocks), "blocks.toml", std::span(&read, 1)).value());
}

std::string itemErrorOf(std::string_view items) {
    auto read = parseItems(items, "items.toml");
    if (!read) return read.error().message;
    auto file = parseBlocks(kBlocks, "blocks.toml").value();
    const auto made =
        BlockRegistry::fromDescriptions(std::move(file.blocks), "blocks.toml", std::span(&*read, 1));
    if (!made) return made.error().message;
    const auto checked = checkItemNames(*made);
    return checked ? "" : checked.error().message;
}

TEST(ItemTable, EachBlockIsAnItem) {
    const auto blocks = registryOf(kItems);
    const ItemTable& items = blocks->items();
    for (const BlockType& type : blocks->types()) {
        const ItemType* item = items.find(type.name);
        const bool isNone = type.id == kAir || type.id == blocks->missing();
        ASSERT_EQ(item == nullptr, isNone) << type.name;
        if (item) {
            EXPECT_EQ(item->block, type.id);
        }
    }
    EXPECT_EQ(items.find("stick")->block, kAir);
    EXPECT_EQ(items.maxStackOf("pick"), 1) << "it wears";
    EXPECT_EQ(items.maxStackOf("stick"), kMaxStack);
}

TEST(ItemTable, BreakingDependsOnTheTool) {
    const auto blocks = registryOf(kItems);
    const Tool hand, pick = blocks->items().find("pick")->tool;
    const BlockType& stone = *blocks->find("stone");
    EXPECT_DOUBLE_EQ(secondsToBreak(stone, hand), 6);
    EXPECT_DOUBLE_EQ(secondsToBreak(stone, pick), 2);
    EXPECT_EQ(dropOf(stone, hand), ItemStack{}) << "stone needs a pick";
    EXPECT_EQ(dropOf(stone, pick), (ItemStack{"cobble", 1}));
    EXPECT_EQ(dropOf(*blocks->find("cobble"), pick), (ItemStack{"cobble", 1})) << "drops are not inherited";
    EXPECT_EQ(dropOf(*blocks->find("iron_ore"), pick), ItemStack{}) << "the pick is too weak";
    const BlockType& log = *blocks->find("log");
    EXPECT_DOUBLE_EQ(secondsToBreak(log, pick), secondsToBreak(log, hand));
    EXPECT_EQ(dropOf(log, hand), (ItemStack{"log", 1}));
    EXPECT_DOUBLE_EQ(secondsToBreak(*blocks->find("flower"), hand), 0);
    EXPECT_EQ(dropOf(*blocks->find("flower"), hand), (ItemStack{"stick", 3}));
}

std::vector<ItemStack> gridOf(std::string_view rows) {
    std::vector<ItemStack> grid;
    for (const char c : rows) {
        const std::string item = c == '#'   ? "cobble"
                                 : c == 's' ? "stone"
                                 : c == '/' ? "stick"
                                 : c == 'l' ? "log"
                                 : c == 'f' ? "flower"
                                            : "";
        grid.push_back({item, static_cast<std::uint16_t>(item.empty() ? 0 : 1)});
    }
    return grid;
}

std::string made(const ItemTable& items, std::string_view rows, int side) {
    const Recipe* recipe = matchingRecipe(items, gridOf(rows), side);
    return recipe ? recipe->makes : "";
}

TEST(Recipes, ShapesFitWhereverTheyLieAndMirrored) {
    const auto blocks = registryOf(kItems);
    const ItemTable& items = blocks->items();
    EXPECT_EQ(made(items, "### /  / ", 3), "pick");
    EXPECT_EQ(made(items, "s#s /  / ", 3), "pick") << "any item of the set";
    EXPECT_EQ(made(items, "###/  /  ", 3), "");
    EXPECT_EQ(made(items, "### / ./ ", 3), "pick") << "a dot is an empty slot";
    EXPECT_EQ(made(items, "### / f/ ", 3), "");
    for (const char* rows : {"// /     ", " // /    ", "   // /  ", "    // / "})
        EXPECT_EQ(made(items, rows, 3), "log") << rows;
    EXPECT_EQ(made(items, "/// ", 2), "log");
    EXPECT_EQ(made(items, "// /", 2), "log") << "mirrored";
    EXPECT_EQ(made(items, "/ //", 2), "") << "upside down";
    EXPECT_EQ(made(items, "    ", 2), "");
}

TEST(Recipes, ShapelessOnesTakeAnyOrder) {
    const auto blocks = registryOf(kItems);
    const ItemTable& items = blocks->items();
    for (const char* rows : {"lf  ", "f  l", " l/ ", "/l  "})
        EXPECT_EQ(made(items, rows, 2), "stick") << rows;
    for (const char* rows : {"l   ", "lff ", "ff  ", "ll  "}) EXPECT_EQ(made(items, rows, 2), "") << rows;
}

// Against a reference that tries all orders of the ingredients.
TEST(Recipes, ShapelessMatchingIsThatOfAllOrders) {
    std::mt19937 random(7);
    const std::vector<std::string> names{"a", "b", "c", "d"};
    for (int round = 0; round < 3000; ++round) {
        Recipe recipe{.makes = "a"};
        const std::size_t count = 1 + random() % 4;
        for (std::size_t k = 0; k < count; ++k) {
            Recipe::Ingredient any;
            for (const std::string& name : names)
                if (random() % 3 == 0) any.push_back(name);
            if (any.empty()) any.push_back(names[random() % 4]);
            recipe.ingredients.push_back(any);
        }
        ItemFile file;
        for (const std::string& name : names) file.items.push_back({.name = name});
        file.recipes.push_back(recipe);
        const ItemTable table({}, 0, std::span(&file, 1));
        std::vector<ItemStack> grid(4);
        for (std::size_t k = 0; k < count; ++k) grid[k] = {names[random() % 4], 1};
        std::vector<std::size_t> order(count);
        std::iota(order.begin(), order.end(), 0);
        bool fits = false;
        do {
            bool all = true;
            for (std::size_t k = 0; k < count; ++k)
                all &= std::ranges::count(recipe.ingredients[order[k]], grid[k].item) > 0;
            fits |= all;
        } while (std::ranges::next_permutation(order).found);
        std::ranges::shuffle(grid, random);
        EXPECT_EQ(matchingRecipe(table, grid, 2) != nullptr, fits);
    }
}

TEST(Items, MistakesNameLineAndKey) {
    EXPECT_THAT(itemErrorOf("[[item]]\nname = \"x\"\nspeed = 2"), HasSubstr("items.toml:3: speed: expected"));
    EXPECT_THAT(itemErrorOf("[[item]]\nname = \"x\"\ncolor = 2"),
                HasSubstr("items.toml:3: color: unknown key"));
    EXPECT_THAT(itemErrorOf("[[item]]\ntexture = \"x\""), HasSubstr("items.toml:1: name"));
    EXPECT_THAT(itemErrorOf("[[item]]\nname = \"x\"\ntool = \"spoon\""), HasSubstr("one of none, pick"));
    EXPECT_THAT(itemErrorOf("[[item]]\nname = \"x\"\ntool = \"axe\"\nstack = 2"), HasSubstr("stack"));
    EXPECT_THAT(itemErrorOf("[[recipe]]\nmakes = \"stone\""), HasSubstr("items.toml:1: shape"));
    EXPECT_THAT(itemErrorOf("[[recipe]]\nmakes = \"stone\"\nof = []"), HasSubstr("of: expected 1 to 9"));
    EXPECT_THAT(itemErrorOf("[[recipe]]\nmakes = \"stone\"\nshape = [\"# \"]\nkeys = { \"#\" = \"log\" }"),
                HasSubstr("shape: expected"));
    EXPECT_THAT(itemErrorOf("[[recipe]]\nmakes = \"stone\"\nshape = [\"#x\"]\nkeys = { \"#\" = \"log\" }"),
                HasSubstr("an item for \"x\""));
    EXPECT_THAT(itemErrorOf("[[item]]\nname = \"stick\"\n[[recipe]]\nmakes = \"stone\"\nof = [\"spoon\"]"),
                HasSubstr("got \"spoon\""));
    EXPECT_THAT(itemErrorOf("[[item]]\nname = \"stone\"\n" + std::string(kItems)),
                HasSubstr("that no item or block has, got \"stone\""));
}

}  // namespace
}  // namespace terrane::world
