#include "terrane/game/items.h"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "terrane/world/blocks/block_behavior.h"

namespace terrane::game {

namespace {

constexpr std::array<std::string_view, Hotbar::kSlots> kFirstBlocks{
    "oak_planks", "cobble", "stone_bricks", "glass", "oak_stairs", "oak_fence", "oak_door", "torch", "dirt"};

}  // namespace

bool isBuildable(const world::BlockType& type, const world::BlockRegistry& blocks) {
    return type.id != world::kAir && type.id != blocks.missing() && !world::isUpperHalf(type);
}

Hotbar defaultHotbar(const world::BlockRegistry& blocks) {
    Hotbar hotbar;
    world::BlockId next = world::kAir;  // for the slots whose block is not there
    for (std::size_t slot = 0; slot < Hotbar::kSlots; ++slot) {
        if (const world::BlockType* type = blocks.find(kFirstBlocks[slot])) {
            hotbar.blocks[slot] = type->id;
            continue;
        }
        while (++next < blocks.types().size() && !isBuildable(blocks.type(next), blocks)) {
        }
        if (next < blocks.types().size()) hotbar.blocks[slot] = next;
    }
    return hotbar;
}

void cycleSlot(Hotbar& hotbar, int steps) {
    constexpr int kCount = Hotbar::kSlots;
    const int slot = static_cast<int>(hotbar.selected) + steps % kCount;
    hotbar.selected = static_cast<std::size_t>((slot + kCount) % kCount);
}

void selectBlock(Hotbar& hotbar, world::BlockId block) {
    const auto found = std::ranges::find(hotbar.blocks, block);
    if (found != hotbar.blocks.end())
        hotbar.selected = static_cast<std::size_t>(found - hotbar.blocks.begin());
    else
        hotbar.blocks[hotbar.selected] = block;
}

std::string textOf(const Hotbar& hotbar, const world::BlockRegistry& blocks) {
    std::string text = std::to_string(hotbar.selected);
    for (const world::BlockId block : hotbar.blocks) text += " " + blocks.type(block).name;
    return text;
}

Hotbar parseHotbar(std::string_view text, const world::BlockRegistry& blocks) {
    Hotbar hotbar = defaultHotbar(blocks);
    std::istringstream words{std::string(text)};
    std::string word;
    words >> word;
    std::size_t chosen = 0;
    const auto read = std::from_chars(word.data(), word.data() + word.size(), chosen);
    if (read.ec == std::errc() && chosen < Hotbar::kSlots) hotbar.selected = chosen;
    for (std::size_t slot = 0; slot < Hotbar::kSlots && words >> word; ++slot) {
        const world::BlockType* type = blocks.find(word);
        if (type && (type->id == world::kAir || isBuildable(*type, blocks))) hotbar.blocks[slot] = type->id;
    }
    return hotbar;
}

namespace {

// ASCII only: other letters are compared as they are.
std::string lowered(std::string_view text) {
    std::string low(text);
    std::ranges::transform(
        low, low.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return low;
}

std::vector<std::string> wordsOf(std::string_view text) {
    std::istringstream in(lowered(text));
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

}  // namespace

std::vector<std::string> paletteGroups(const world::BlockRegistry& blocks) {
    std::vector<std::string> groups;
    for (const world::BlockType& type : blocks.types())
        if (isBuildable(type, blocks) && std::ranges::find(groups, type.group) == groups.end())
            groups.push_back(type.group);
    return groups;
}

std::vector<world::BlockId> paletteBlocks(const world::BlockRegistry& blocks, const PaletteFilter& filter) {
    const std::vector<std::string> words = wordsOf(filter.search);
    std::vector<world::BlockId> first, others;
    for (const world::BlockType& type : blocks.types()) {
        if (!isBuildable(type, blocks) || (!filter.group.empty() && type.group != filter.group)) continue;
        const std::string shown = lowered(filter.displayName(type.id)), text = shown + " " + type.name;
        const bool fits = std::ranges::all_of(
            words, [&](const std::string& word) { return text.find(word) != std::string::npos; });
        if (!fits) continue;
        (words.empty() || shown.starts_with(words.front()) ? first : others).push_back(type.id);
    }
    first.insert(first.end(), others.begin(), others.end());
    return first;
}

bool isContainer(const world::World& world, const world::BlockRegistry& blocks, world::BlockPos pos) {
    return world::behaviorWith(blocks.type(world.block(pos)), &world::BlockBehavior::items) != nullptr;
}

base::Result<world::Inventory> itemsOf(const world::World& world, const world::BlockRegistry& blocks,
                                       world::BlockPos pos) {
    const world::BlockType& type = blocks.type(world.block(pos));
    const world::BlockBehavior* behavior = world::behaviorWith(type, &world::BlockBehavior::items);
    if (!behavior) return world::Inventory();
    auto items = behavior->items(world, blocks, pos);
    if (!items)
        return base::fail("the {} at {},{},{}: {}", type.name, pos.x, pos.y, pos.z, items.error().message);
    return items;
}

bool maySetItems(const world::World& world, const world::BlockRegistry& blocks, world::BlockPos pos,
                 const world::BlockEntityData& data) {
    const int slots = blocks.type(world.block(pos)).slots;
    if (slots == 0 || data.empty()) return true;
    const auto next = world::decodeSlots(data);
    const auto former = itemsOf(world, blocks, pos);
    return next && world::mayReplace(former.value_or(world::Inventory()), *next, slots);
}

bool clickSlot(world::Inventory& items, const world::BlockRegistry& blocks, const SlotClick& click,
               world::BlockId& heldBlock) {
    if (click.slot >= items.size()) return false;
    const int count = click.wholeStack ? world::kMaxStack : 1;
    world::ItemStack& stack = items[click.slot];
    if (!click.takes && heldBlock == world::kAir) return false;
    if (!click.takes) return world::addToStack(stack, blocks.type(heldBlock).name, count) < count;
    const world::BlockType* kind = blocks.find(stack.item);
    if (stack.count == 0 || !kind) return false;
    heldBlock = kind->id;
    return world::takeFromStack(stack, count) > 0;
}

EditResult putItems(Session& session, PlayerId player, world::BlockPos pos, const world::Inventory& items) {
    return session.edit(
        {player, pos, world::SetEntityData{world::encodeInventory(items)}, session.world().block(pos)});
}

}  // namespace terrane::game
