#include "terrane/game/hotbar.h"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "terrane/world/shape_behaviors.h"

namespace terrane::game {
namespace {

constexpr std::array<std::string_view, Hotbar::kSlots> kFirstBlocks{
    "oak_planks", "cobble", "stone_bricks", "glass", "oak_stairs", "oak_fence", "oak_door", "torch", "dirt"};

}  // namespace

bool isBuilt(const world::BlockType& type, const world::BlockRegistry& blocks) {
    return type.id != world::kAir && type.id != blocks.missing() && !world::isUpperHalf(type);
}

Hotbar firstHotbar(const world::BlockRegistry& blocks) {
    Hotbar hotbar;
    world::BlockId next = world::kAir;  // for the slots whose block is not there
    for (std::size_t slot = 0; slot < Hotbar::kSlots; ++slot) {
        if (const world::BlockType* type = blocks.find(kFirstBlocks[slot])) {
            hotbar.blocks[slot] = type->id;
            continue;
        }
        while (++next < blocks.types().size() && !isBuilt(blocks.type(next), blocks)) {
        }
        if (next < blocks.types().size()) hotbar.blocks[slot] = next;
    }
    return hotbar;
}

void stepSlot(Hotbar& hotbar, int steps) {
    constexpr int kCount = Hotbar::kSlots;
    const int slot = static_cast<int>(hotbar.chosen) + steps % kCount;
    hotbar.chosen = static_cast<std::size_t>((slot + kCount) % kCount);
}

void takeInHand(Hotbar& hotbar, world::BlockId block) {
    const auto found = std::ranges::find(hotbar.blocks, block);
    if (found != hotbar.blocks.end())
        hotbar.chosen = static_cast<std::size_t>(found - hotbar.blocks.begin());
    else
        hotbar.blocks[hotbar.chosen] = block;
}

std::string textOf(const Hotbar& hotbar, const world::BlockRegistry& blocks) {
    std::string text = std::to_string(hotbar.chosen);
    for (const world::BlockId block : hotbar.blocks) text += " " + blocks.type(block).name;
    return text;
}

Hotbar hotbarFrom(std::string_view text, const world::BlockRegistry& blocks) {
    Hotbar hotbar = firstHotbar(blocks);
    std::istringstream words{std::string(text)};
    std::string word;
    words >> word;
    std::size_t chosen = 0;
    const auto read = std::from_chars(word.data(), word.data() + word.size(), chosen);
    if (read.ec == std::errc() && chosen < Hotbar::kSlots) hotbar.chosen = chosen;
    for (std::size_t slot = 0; slot < Hotbar::kSlots && words >> word; ++slot) {
        const world::BlockType* type = blocks.find(word);
        if (type && (type->id == world::kAir || isBuilt(*type, blocks))) hotbar.blocks[slot] = type->id;
    }
    return hotbar;
}

}  // namespace terrane::game
