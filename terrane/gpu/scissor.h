// Draws and clears of color and depth reach only a rectangle of the target, as long as this lives. Copies are
// not bounded. One at a time. Used on the thread of the context.
#pragma once

#include <epoxy/gl.h>

#include <glm/vec2.hpp>

namespace terrane::gpu {

class Scissor {
  public:
    // Pixels; row 0 is the lowest.
    Scissor(glm::ivec2 corner, glm::ivec2 size) {
        glScissor(corner.x, corner.y, size.x, size.y);
        glEnable(GL_SCISSOR_TEST);
    }
    ~Scissor() { glDisable(GL_SCISSOR_TEST); }
    Scissor(const Scissor&) = delete;
    Scissor& operator=(const Scissor&) = delete;
};

}  // namespace terrane::gpu
