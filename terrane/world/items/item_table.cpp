#include "terrane/world/items/item_table.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <unordered_set>
#include <utility>

#include "terrane/base/text.h"
#include "terrane/world/blocks/block_behavior.h"
#include "terrane/world/blocks/block_parser.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/blocks/content_table.h"

namespace terrane::world {
namespace {

constexpr std::size_t kMaxItems = 16384, kMaxRecipes = 16384, kMaxIngredients = 64;
constexpr double kMaxToolSpeed = 100;
constexpr int kMaxUses = 60'000;
constexpr int kMaxFood = 100;

constexpr std::array<std::string_view, 8> kItemKeys{"name",  "texture", "stack", "tool",
                                                    "level", "speed",   "uses",  "food"};
constexpr std::array<std::string_view, 5> kRecipeKeys{"makes", "count", "shape", "keys", "of"};

using Sets = std::map<std::string, Recipe::Ingredient, std::less<>>;

// A name with letters as in Lua scripts and chats: "coal", "isles:amber".
bool isItemName(std::string_view name) {
    return !name.empty() && name.size() <= kMaxItemName && std::ranges::all_of(name, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == ':';
    });
}

std::string itemNameOf(ContentTable& table, const toml::node& value, std::string_view key) {
    const auto name = value.value_exact<std::string>();
    if (name && isItemName(*name)) return *name;
    table.expected(value, key, "the name of an item");
    return {};
}

ItemType readItem(ContentTable& table) {
    ItemType item;
    table.rejectUnknown(kItemKeys);
    if (const toml::node* name = table.own("name"))
        item.name = table.nameOf(*name, "name");
    else
        table.missing("name");
    const toml::node* texture = table.own("texture");
    item.texture = texture ? table.nameOf(*texture, "texture") : item.name;
    if (const toml::node* value = table.own("tool"))
        item.tool.kind = table.enumOf(*value, "tool", kToolKinds);
    const bool isTool = item.tool.kind != ToolKind::None;
    if (const toml::node* value = table.own("level"))
        item.tool.level = table.numberOf(*value, "level", 0, kMaxToolLevel);
    if (const toml::node* value = table.own("speed"))
        item.tool.speed = table.realOf(*value, "speed", 1, kMaxToolSpeed);
    if (const toml::node* value = table.own("uses"))
        item.tool.uses = static_cast<std::uint16_t>(table.numberOf(*value, "uses", 0, kMaxUses));
    for (const std::string_view key : {"level", "speed", "uses"})
        if (const toml::node* value = table.own(key); value && !isTool)
            table.expected(*value, key, fmt::format("{} only with the key tool", key));
    if (isTool) item.maxStack = 1;
    if (const toml::node* value = table.own("stack")) {
        // Stacks of tools would wear together.
        const int most = isTool ? 1 : kMaxStack;
        item.maxStack = static_cast<std::uint16_t>(table.numberOf(*value, "stack", 1, most));
    }
    if (const toml::node* value = table.own("food")) item.food = table.numberOf(*value, "food", 0, kMaxFood);
    return item;
}

// The items of an ingredient: a name of a set or an item, or a list of these.
Recipe::Ingredient ingredientOf(ContentTable& table, const toml::node& value, std::string_view key,
                                const Sets& sets) {
    Recipe::Ingredient items;
    const auto add = [&](const toml::node& node) {
        const std::string name = itemNameOf(table, node, key);
        if (const auto set = sets.find(name); set != sets.end())
            items.insert(items.end(), set->second.begin(), set->second.end());
        else
            items.push_back(name);
    };
    const toml::array* several = value.as_array();
    if (!several) {
        add(value);
        return items;
    }
    if (several->empty() || several->size() > kMaxIngredients)
        table.expected(value, key, fmt::format("1 to {} names of items", kMaxIngredients));
    for (std::size_t k = 0; k < several->size() && k < kMaxIngredients; ++k) add((*several)[k]);
    return items;
}

Sets readSets(ContentTable& top) {
    Sets sets;
    const toml::node* found = top.node("sets");
    if (!found) return sets;
    const toml::table* entries = found->as_table();
    if (!entries) {
        top.expected(*found, "sets", "a table of lists of items");
        return sets;
    }
    for (const auto& [name, node] : *entries) {
        const std::string key = fmt::format("sets.{}", name.str());
        if (!node.is_array()) top.expected(node, key, "a list of names of items");
        sets.emplace(name.str(), ingredientOf(top, node, key, {}));
    }
    return sets;
}

bool hasEmptyEdge(const Recipe& recipe) {
    const auto isEmpty = [&](int from, int step, int count) {
        for (int k = 0; k < count; ++k)
            if (!recipe.ingredients[static_cast<std::size_t>(from + k * step)].empty()) return false;
        return true;
    };
    const int w = recipe.width, h = recipe.height;
    return isEmpty(0, 1, w) || isEmpty((h - 1) * w, 1, w) || isEmpty(0, w, h) || isEmpty(w - 1, w, h);
}

// The cells of a shaped recipe.
void readGrid(ContentTable& table, const toml::node& shape, const Sets& sets, Recipe& recipe) {
    const auto expected = [&] {
        table.expected(shape, "shape",
                       "1 to 3 rows of 1 to 3 characters, all as long, with no row or column of spaces at an "
                       "edge");
    };
    const toml::array* rows = shape.as_array();
    if (!rows || rows->empty() || rows->size() > kMaxGridSide) return expected();
    const toml::node* keys = table.own("keys");
    const toml::table* named = keys ? keys->as_table() : nullptr;
    if (!named) return table.missing("keys", "a table with an item for each character of shape");
    for (const toml::node& row : *rows) {
        const auto text = row.value_exact<std::string>();
        if (!text || text->empty() || text->size() > kMaxGridSide) return expected();
        if (recipe.height++ > 0 && recipe.width != static_cast<int>(text->size())) return expected();
        recipe.width = static_cast<int>(text->size());
        for (const char c : *text) {
            recipe.ingredients.emplace_back();
            if (c == ' ') continue;
            const toml::node* item = named->get(std::string_view(&c, 1));
            if (!item)
                return table.expected(*keys, "keys",
                                      fmt::format("an item for \"{}\"", base::printable({&c, 1})));
            recipe.ingredients.back() = ingredientOf(table, *item, fmt::format("keys.{}", c), sets);
        }
    }
    if (hasEmptyEdge(recipe)) expected();
}

Recipe readRecipe(ContentTable& table, const Sets& sets) {
    Recipe recipe;
    table.rejectUnknown(kRecipeKeys);
    if (const toml::node* makes = table.own("makes"))
        recipe.makes = itemNameOf(table, *makes, "makes");
    else
        table.missing("makes");
    if (const toml::node* value = table.own("count"))
        recipe.count = table.numberOf(*value, "count", 1, kMaxStack);
    const toml::node* shape = table.own("shape");
    const toml::node* of = table.own("of");
    if (!shape == !of) {
        table.missing("shape", "or of");
    } else if (shape) {
        readGrid(table, *shape, sets, recipe);
    } else {
        const toml::array* items = of->as_array();
        constexpr std::size_t kMost = std::size_t{kMaxGridSide} * kMaxGridSide;
        if (!items || items->empty() || items->size() > kMost)
            table.expected(*of, "of", fmt::format("1 to {} names of items", kMost));
        else
            for (const toml::node& item : *items)
                recipe.ingredients.push_back(ingredientOf(table, item, "of", sets));
    }
    return recipe;
}

// The tables of a kind, at most `most`; null if there are none.
const toml::array* itemTablesOf(ContentTable& top, std::string_view kind, std::size_t most) {
    const toml::node* found = top.node(kind);
    const toml::array* tables = found ? found->as_array() : nullptr;
    if (found && !(tables && tables->is_homogeneous<toml::table>() && tables->size() <= most))
        top.expected(*found, kind, fmt::format("at most {} tables that begin with [[{}]]", most, kind));
    return tables;
}

}  // namespace

base::Result<ItemFile> parseItems(std::string_view toml, std::string_view file) {
    const toml::table root = TERRANE_TRY(base::parseToml(toml, file));
    std::optional<std::string> error;
    ItemFile read;
    ContentTable top(root, file, error);
    top.rejectUnknown(std::initializer_list<std::string_view>{"item", "recipe", "sets"});
    const Sets sets = readSets(top);
    const toml::array* items = itemTablesOf(top, "item", kMaxItems);
    for (std::size_t k = 0; items && !error && k < items->size(); ++k) {
        ContentTable table(*(*items)[k].as_table(), file, error);
        read.items.push_back(readItem(table));
        read.itemLines.push_back(table.line());
    }
    const toml::array* recipes = itemTablesOf(top, "recipe", kMaxRecipes);
    for (std::size_t k = 0; recipes && !error && k < recipes->size(); ++k) {
        ContentTable table(*(*recipes)[k].as_table(), file, error);
        read.recipes.push_back(readRecipe(table, sets));
        read.recipeLines.push_back(table.line());
    }
    if (error) return base::fail(base::ErrorCode::BadInput, "{}", base::inOneLine(std::move(*error)));
    return read;
}

ItemTable::ItemTable(std::span<const BlockType> blocks, BlockId missing, std::span<const ItemFile> files) {
    for (const BlockType& type : blocks) {
        if (type.id == kAir || type.id == missing || isUpperHalf(type)) continue;
        types_.push_back({.name = type.name, .block = type.id});
    }
    for (const ItemFile& file : files) {
        types_.insert(types_.end(), file.items.begin(), file.items.end());
        recipes_.insert(recipes_.end(), file.recipes.begin(), file.recipes.end());
    }
    for (std::size_t k = 0; k < types_.size(); ++k) byName_.emplace(types_[k].name, k);
}

const ItemType* ItemTable::find(std::string_view name) const {
    const auto found = byName_.find(std::string(name));
    return found == byName_.end() ? nullptr : &types_[found->second];
}

int ItemTable::maxStackOf(std::string_view name) const {
    const ItemType* type = find(name);
    return type ? type->maxStack : kMaxStack;
}

base::Result<void> checkItemNames(const BlockRegistry& blocks) {
    const ItemTable& table = blocks.items();
    const auto fail = [](std::string_view where, std::string_view what, std::string_view name) {
        return base::fail(base::ErrorCode::BadInput, "{}: {}, got \"{}\"", where, what,
                          base::printable(name));
    };
    std::unordered_set<std::string_view> names{"air", "missing"};
    for (const ItemType& type : table.types())
        if (!names.insert(type.name).second)
            return fail("items.toml: name", "expected a name that no item or block has", type.name);
    for (const BlockType& block : blocks.types())
        if (!block.drop.item.empty() && !table.find(block.drop.item))
            return fail(fmt::format("blocks.toml: drops of {}", block.name), "expected the name of an item",
                        block.drop.item);
    for (const Recipe& recipe : table.recipes()) {
        const std::string where = fmt::format("items.toml: the recipe of {}", recipe.makes);
        if (!table.find(recipe.makes)) return fail(where, "expected the name of an item", recipe.makes);
        for (const Recipe::Ingredient& ingredient : recipe.ingredients)
            for (const std::string& name : ingredient)
                if (!table.find(name)) return fail(where, "expected the name of an item", name);
    }
    return {};
}

double secondsToBreak(const BlockType& block, const Tool& tool) {
    const bool helps = block.tool != ToolKind::None && tool.kind == block.tool;
    return block.hardness / (helps ? tool.speed : 1);
}

ItemStack dropOf(const BlockType& block, const Tool& tool) {
    const bool isStrong = block.toolLevel == 0 || (tool.kind == block.tool && tool.level >= block.toolLevel);
    if (!isStrong || block.drop.count == 0 || block.id == kAir) return {};
    return {block.drop.item.empty() ? block.name : block.drop.item,
            static_cast<std::uint16_t>(block.drop.count)};
}

namespace {

bool isOne(const Recipe::Ingredient& ingredient, const ItemStack& stack) {
    if (stack.count == 0 || ingredient.empty()) return stack.count == 0 && ingredient.empty();
    return std::ranges::find(ingredient, stack.item) != ingredient.end();
}

// The stacks of a grid, without empty rows and columns around them.
struct Trimmed {
    int width = 0, height = 0;
    std::vector<const ItemStack*> stacks;
};

Trimmed trimmed(std::span<const ItemStack> grid, int side) {
    int left = side, right = -1, top = side, bottom = -1;
    for (int k = 0; k < side * side; ++k) {
        if (grid[static_cast<std::size_t>(k)].count == 0) continue;
        left = std::min(left, k % side);
        right = std::max(right, k % side);
        top = std::min(top, k / side);
        bottom = std::max(bottom, k / side);
    }
    Trimmed rest{std::max(right - left + 1, 0), std::max(bottom - top + 1, 0), {}};
    for (int y = top; y <= bottom; ++y)
        for (int x = left; x <= right; ++x)
            rest.stacks.push_back(&grid[static_cast<std::size_t>(y * side + x)]);
    return rest;
}

bool fitsShape(const Recipe& recipe, const Trimmed& grid, bool isMirrored) {
    if (recipe.width != grid.width || recipe.height != grid.height) return false;
    for (int y = 0; y < grid.height; ++y)
        for (int x = 0; x < grid.width; ++x) {
            const int from = isMirrored ? grid.width - 1 - x : x;
            const auto cell = static_cast<std::size_t>(y * grid.width + from);
            const auto at = static_cast<std::size_t>(y * grid.width + x);
            if (!isOne(recipe.ingredients[cell], *grid.stacks[at])) return false;
        }
    return true;
}

// Whether each ingredient finds a stack of its own, by the augmenting paths of bipartite matching.
bool fitsAnywhere(const Recipe& recipe, const Trimmed& grid) {
    std::vector<const ItemStack*> stacks;
    std::ranges::copy_if(grid.stacks, std::back_inserter(stacks),
                         [](const ItemStack* stack) { return stack->count > 0; });
    if (stacks.size() != recipe.ingredients.size()) return false;
    std::vector<int> owner(stacks.size(), -1);
    const auto place = [&](const auto& self, std::size_t ingredient, std::vector<bool>& tried) -> bool {
        for (std::size_t k = 0; k < stacks.size(); ++k) {
            if (tried[k] || !isOne(recipe.ingredients[ingredient], *stacks[k])) continue;
            tried[k] = true;
            if (owner[k] >= 0 && !self(self, static_cast<std::size_t>(owner[k]), tried)) continue;
            owner[k] = static_cast<int>(ingredient);
            return true;
        }
        return false;
    };
    for (std::size_t k = 0; k < recipe.ingredients.size(); ++k) {
        std::vector<bool> tried(stacks.size());
        if (!place(place, k, tried)) return false;
    }
    return true;
}

}  // namespace

const Recipe* matchingRecipe(const ItemTable& table, std::span<const ItemStack> grid, int side) {
    base::require(side >= 1 && side <= kMaxGridSide && grid.size() == static_cast<std::size_t>(side * side),
                  "matchingRecipe: a grid is square, of at most 3×3 stacks");
    const Trimmed rest = trimmed(grid, side);
    if (rest.stacks.empty()) return nullptr;
    for (const Recipe& recipe : table.recipes()) {
        const bool isShaped = recipe.width > 0;
        if (isShaped ? fitsShape(recipe, rest, false) || fitsShape(recipe, rest, true)
                     : fitsAnywhere(recipe, rest))
            return &recipe;
    }
    return nullptr;
}

}  // namespace terrane::world
