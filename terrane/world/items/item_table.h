// Items: what players and chests hold. Every block that players can build with is an item; further items,
// such as tools, and recipes come from files items.toml of content packs (docs/packs.md). Also the pure
// functions of survival: how long breaking takes, what it gives, what a recipe makes. Immutable tables,
// shared by all threads.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/world/blocks/block_type.h"
#include "terrane/world/blocks/inventory.h"

namespace terrane::world {

// The use of an item as a tool.
struct Tool {
    ToolKind kind = ToolKind::None;
    int level = 0;           // blocks with a higher one drop nothing
    double speed = 1;        // a block of this kind breaks as many times faster
    std::uint16_t uses = 0;  // until it is worn out; 0: never
};

struct ItemType {
    std::string name;          // one of all items and blocks
    BlockId block = kAir;      // that it places; kAir: none
    std::string texture = {};  // of an item that is no block
    std::uint16_t maxStack = kMaxStack;
    Tool tool = {};
    int food = 0;  // above 0: using the item takes one of it
};

// A recipe for a grid of crafting. An ingredient is a list of items of which one is needed.
struct Recipe {
    using Ingredient = std::vector<std::string>;

    int width = 0, height = 0;                 // 0: the ingredients may lie anywhere
    std::vector<Ingredient> ingredients = {};  // by row; of a shaped recipe empty ones too
    std::string makes = {};
    int count = 1;
};

constexpr int kMaxGridSide = 3;

// The content of an items.toml.
struct ItemFile {
    std::vector<ItemType> items;
    std::vector<Recipe> recipes;
    std::vector<int> itemLines, recipeLines;  // in the file, for messages
};

// Parses a file. Errors read "file:line: key: what is wrong", always in one line.
[[nodiscard]] base::Result<ItemFile> parseItems(std::string_view toml, std::string_view file);

class ItemTable {
  public:
    // Makes an item of each block type that players can build with, and adds those of the files.
    ItemTable(std::span<const BlockType> blocks, BlockId missing, std::span<const ItemFile> files);

    std::span<const ItemType> types() const { return types_; }
    std::span<const Recipe> recipes() const { return recipes_; }
    const ItemType* find(std::string_view name) const;  // null if there is none
    // Returns how many of them a stack holds; kMaxStack for unknown ones.
    int maxStackOf(std::string_view name) const;

  private:
    std::vector<ItemType> types_;
    std::vector<Recipe> recipes_;
    std::unordered_map<std::string, std::size_t> byName_;
};

class BlockRegistry;  // blocks/block_registry.h

// Checks that the names in drops and recipes are items, and that no item has the name of another. A block
// whose drop is no item gives nothing.
[[nodiscard]] base::Result<void> checkItemNames(const BlockRegistry& blocks);

// Returns the seconds that a player needs to break the block with a tool, which may be none.
double secondsToBreak(const BlockType& block, const Tool& tool);
// Returns what the block gives when it is broken with a tool; an empty stack: nothing.
ItemStack dropOf(const BlockType& block, const Tool& tool);

// Returns the recipe that fits a square grid of stacks, by rows; null if there is none. `side` is at most
// kMaxGridSide.
const Recipe* matchingRecipe(const ItemTable& table, std::span<const ItemStack> grid, int side);

}  // namespace terrane::world
