// Fills the cracks at T-junctions: holes of one sample in the G-buffer, between quads of different sizes,
// that show something farther. The method of D. Čejchan's thesis; with edge_expansion.glsl there are no
// holes. Used by the renderer on the context's thread.
#pragma once

#include "terrane/render/frame/frame_targets.h"
#include "terrane/render/frame/fullscreen_pass.h"

namespace terrane::render {

class HoleFill {
  public:
    HoleFill() = default;
    explicit HoleFill(const gpu::ShaderLoader& shaders);

    // Allocates a second G-buffer, which is read while the first is written, or frees it: eight bytes a
    // sample.
    base::Result<void> configure(const FrameTargets& targets, bool isOn);
    bool isOn() const { return surface_.id() != 0; }
    // Fills the holes of the G-buffer.
    void draw(gpu::Pipeline& pipeline, const FrameTargets& targets) const;
    std::size_t gpuBytes() const { return surface_.sizeBytes() + depth_.sizeBytes(); }

  private:
    FullscreenPass fill_;
    MsaaTexture surface_, depth_;
    glm::ivec2 size_{0};
};

}  // namespace terrane::render
