// The dialog of all blocks, by group and with search. Immediate mode: drawn each frame.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "apps/terrane/window/hotbar_view.h"
#include "apps/terrane/window/overlay.h"
#include "apps/terrane/window/text.h"
#include "terrane/game/block_palette.h"

namespace terrane::app {

struct PaletteState {
    bool isOpen = false;
    std::array<char, 48> search{};
    std::size_t group = 0;                   // 0: all; else 1 + index into game::paletteGroups()
    world::BlockId pointedAt = world::kAir;  // under the cursor, or selected with arrow keys

    void open() { *this = {.isOpen = true, .search = {}, .group = group}; }
};

// None until a block is clicked or chosen with Enter.
std::optional<world::BlockId> drawPalette(const Screen& screen, PaletteState& state,
                                          const world::BlockRegistry& blocks, const BlockFace& face,
                                          const Texts& tr);

}  // namespace terrane::app
