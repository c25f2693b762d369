// The nine blocks at hand, at the bottom of the image. Immediate mode: drawn each frame.
#pragma once

#include <functional>
#include <string>

#include "apps/terrane/window/overlay.h"
#include "terrane/game/hotbar.h"

struct ImDrawList;

namespace terrane::app {

// How the user interface shows blocks.
struct BlockFace {
    std::function<unsigned(world::BlockId)> image;    // an OpenGL texture; 0: none yet
    std::function<std::string(world::BlockId)> name;  // as people read it
};

// The chosen block's name is shown for a moment after it changed.
class HotbarView {
  public:
    void draw(const Screen& screen, const game::Hotbar& hotbar, const BlockFace& face, double seconds);

  private:
    game::Hotbar shown_;
    double nameSeconds_ = 0;
};

// An image of a block in a square of the window or list that draws.
void drawBlockImage(ImDrawList& draw, glm::vec2 min, float side, unsigned image);

float hotbarHeight();  // with its margin; during a frame

}  // namespace terrane::app
