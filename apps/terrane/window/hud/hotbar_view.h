// The nine slots of the hotbar, at the bottom of the image. Immediate mode: drawn each frame.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>

#include "apps/terrane/window/hud/overlay_layout.h"
#include "apps/terrane/window/text.h"
#include "terrane/game/items.h"

struct ImDrawList;

namespace terrane::app {

// Image and name of a block in the user interface.
struct BlockFace {
    std::function<unsigned(world::BlockId)> image;    // an OpenGL texture; 0: none yet
    std::function<std::string(world::BlockId)> name;  // translated
};

// The slots of the hotbar: blocks in creative, the first stacks of a player in survival.
struct HotbarLook {
    std::size_t selected = 0;
    std::string name;  // of what the chosen slot holds; empty: nothing
    std::function<void(std::size_t slot, ImDrawList& draw, glm::vec2 min, float side)> drawSlot;
};

// Shows the chosen block's name for a moment after a change.
class HotbarView {
  public:
    // `seconds`: since the last frame.
    void draw(OverlayLayout& layout, const HotbarLook& look, double seconds);

  private:
    std::string shown_;  // name of the chosen slot's content
    std::size_t selected_ = 0;
    double nameSeconds_ = 0;
};

// Draws the image of a block in a square of the current window or list.
void drawBlockImage(ImDrawList& draw, glm::vec2 min, float side, unsigned image);

float hotbarHeight();  // with its margin; during a frame

// The dialog of all blocks, by group and with search. Immediate mode: drawn each frame.
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
