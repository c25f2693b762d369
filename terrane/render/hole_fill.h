// Fills what T-junctions leave open: holes of one sample in the G-buffer, between quads of different sizes,
// through which one sees something farther. The way of D. Čejchan's thesis; edge_expansion.glsl leaves no
// hole in the first place. Used by the renderer on the context's thread.
#pragma once

#include "terrane/render/frame_targets.h"
#include "terrane/render/fullscreen_pass.h"

namespace terrane::render {

class HoleFill {
  public:
    HoleFill() = default;
    explicit HoleFill(const gpu::ShaderLoader& shaders);

    // Makes room for a second G-buffer, which is read while the first is written, or none: eight bytes a
    // sample.
    base::Result<void> configure(const FrameTargets& targets, bool isOn);
    bool isOn() const { return surface_.id() != 0; }
    // In the G-buffer.
    void draw(gpu::Pipeline& pipeline, const FrameTargets& targets) const;
    std::size_t gpuBytes() const { return surface_.sizeBytes() + depth_.sizeBytes(); }

  private:
    FullscreenPass fill_;
    MsaaTexture surface_, depth_;
    glm::ivec2 size_{0};
};

}  // namespace terrane::render
