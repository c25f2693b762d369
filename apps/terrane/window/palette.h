// All blocks to choose from, by group and by search. Immediate mode: drawn each frame.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "apps/terrane/window/hotbar_view.h"
#include "apps/terrane/window/overlay.h"
#include "terrane/game/block_palette.h"

namespace terrane::app {

struct PaletteState {
    bool isOpen = false;
    std::array<char, 48> search{};
    std::size_t group = 0;  // index into game::paletteGroups(), behind "all"

    void open() { *this = {.isOpen = true, .search = {}, .group = group}; }
};

struct PaletteChoice {
    world::BlockId block = world::kAir;
    std::optional<std::size_t> slot;  // by its digit, while the palette stays open; else into the hand
};

// Nothing until a block is clicked, chosen with Enter, or put into a slot with its digit.
std::optional<PaletteChoice> drawPalette(const Screen& screen, PaletteState& state,
                                         const world::BlockRegistry& blocks, const BlockFace& face);

}  // namespace terrane::app
