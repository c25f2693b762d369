// Rays of the sun or moon between objects in front of it, in screen space. Used by the renderer on the
// context's thread.
#pragma once

#include "terrane/gpu/texture.h"
#include "terrane/render/frame/frame_targets.h"
#include "terrane/render/frame/fullscreen_pass.h"

namespace terrane::render {

class GodRays {
  public:
    GodRays() = default;
    explicit GodRays(const gpu::ShaderLoader& shaders);

    // Allocates the rays at a third of the size, or frees them.
    base::Result<void> configure(glm::ivec2 size, bool isOn);
    // Draws the rays from the scene's coverage.
    void draw(gpu::Pipeline& pipeline, const FrameTargets& targets) const;
    bool isOn() const { return size_.x > 0; }
    void bindResult() const;
    std::size_t gpuBytes() const { return sampled_.texture.sizeBytes() + smoothed_.texture.sizeBytes(); }

  private:
    FullscreenPass sample_, smooth_;
    gpu::Sampler linear_, nearest_;
    ColorTarget sampled_, smoothed_;
    glm::ivec2 size_{0};
};

}  // namespace terrane::render
