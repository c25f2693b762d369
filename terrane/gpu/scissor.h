// Limits draws and clears of color and depth to a rectangle of the target while it lives. Copies are not
// limited. One at a time. Used on the thread of the context.
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
