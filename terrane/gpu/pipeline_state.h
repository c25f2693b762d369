// The fixed-function state of a draw. Each draw states all of it, so that no pass depends on the state left
// by the previous one. It is used on the thread of the context.
#pragma once

#include <epoxy/gl.h>
#include <glm/vec2.hpp>

#include <cstdint>

namespace terrane::gpu {

// The comparison of a fragment's depth with the target's that must hold for the fragment to pass. Off also
// writes no depth.
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

// Sets the state of its context, and only the members that differ from the current ones. Every object that
// draws in the context has a Pipeline of its own.
class Pipeline {
  public:
    void set(const PipelineState& state);
    // Call this if other code may have changed the state: the next set() sets all of it.
    void invalidate() { isKnown_ = false; }

  private:
    PipelineState current_;
    bool isKnown_ = false;
};

// Limits draws and clears of color and depth to a rectangle of the target while it lives. Copies are not
// limited. One at a time. It is used on the thread of the context.
class Scissor {
  public:
    // The rectangle is in pixels; row 0 is the lowest.
    Scissor(glm::ivec2 corner, glm::ivec2 size) {
        glScissor(corner.x, corner.y, size.x, size.y);
        glEnable(GL_SCISSOR_TEST);
    }
    ~Scissor() { glDisable(GL_SCISSOR_TEST); }
    Scissor(const Scissor&) = delete;
    Scissor& operator=(const Scissor&) = delete;
};

}  // namespace terrane::gpu
