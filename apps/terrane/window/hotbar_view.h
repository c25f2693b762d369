// The nine slots of the hotbar, at the bottom of the image. Immediate mode: drawn each frame.
#pragma once

#include <functional>
#include <string>

#include "apps/terrane/window/overlay.h"
#include "terrane/game/hotbar.h"

struct ImDrawList;

namespace terrane::app {

// Image and name of a block in the user interface.
struct BlockFace {
    std::function<unsigned(world::BlockId)> image;    // an OpenGL texture; 0: none yet
    std::function<std::string(world::BlockId)> name;  // translated
};

// Shows the chosen block's name for a moment after a change.
class HotbarView {
  public:
    void draw(const Screen& screen, const game::Hotbar& hotbar, const BlockFace& face, double seconds);

  private:
    game::Hotbar shown_;
    double nameSeconds_ = 0;
};

// Draws the image of a block in a square of the current window or list.
void drawBlockImage(ImDrawList& draw, glm::vec2 min, float side, unsigned image);

float hotbarHeight();  // with its margin; during a frame

}  // namespace terrane::app
