// The fixed-function state of a draw. Each draw states all of it, so that no pass depends on the state left
// by the previous one. Used on the thread of the context.
#pragma once

#include <epoxy/gl.h>
#include <glm/vec2.hpp>

#include <cstdint>

namespace terrane::gpu {

// Comparison of a fragment's depth with that of the target that must hold for it to pass. Off also writes no
// depth.
enum class DepthTest : std::uint8_t { Off, Always, Less, Equal, Greater };
// Over: premultiplied color over the target.
// Through: color plus the target times the second output of the shader, for each channel.
enum class Blending : std::uint8_t { Off, Over, Through };

struct PipelineState {
    DepthTest depthTest = DepthTest::Off;
    bool writesDepth = true;   // clears of a target's depth need it too
    bool clampsDepth = false;  // instead of clipping at the near and far plane
    glm::vec2 depthRange{0, 1};
    Blending blending = Blending::Off;
    bool cullsBackFaces = false;
    // The fragment shader reads gl_SampleID into several samples a pixel, so that it runs once for each
    // sample (GLSL 4.50, Fragment Shader Special Variables). Mesa 22.3.6, zink on lavapipe, runs it for
    // sample 0 alone when the draw before it ran once a pixel, until the sample mask changes: so such draws
    // have a mask of their own, with all samples in it.
    bool readsSampleId = false;

    bool operator==(const PipelineState&) const = default;
};

// Sets the state of its context, and only what differs from the state before. Every object that draws in the
// context has its own.
class Pipeline {
  public:
    void set(const PipelineState& state);
    // Other code may have changed the state: the next set() sets all of it.
    void forget() { isKnown_ = false; }

  private:
    PipelineState current_;
    bool isKnown_ = false;
};

// Limits draws and clears of color and depth to a rectangle of the target while it lives. Copies are not
// limited. One at a time. Used on the thread of the context.
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
