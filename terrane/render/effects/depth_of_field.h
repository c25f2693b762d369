// Depth of field: blurs distant objects. Used by the renderer on the context's thread.
#pragma once

#include "terrane/gpu/texture.h"
#include "terrane/render/frame/frame_targets.h"
#include "terrane/render/frame/fullscreen_pass.h"

namespace terrane::render {

class DepthOfField {
  public:
    DepthOfField() = default;
    explicit DepthOfField(const gpu::ShaderLoader& shaders);

    // Allocates the blurred image at half the size, or frees it.
    base::Result<void> configure(const FrameTargets& targets, bool isOn);
    // Blurs the scene. `depth`: of the nearest surfaces, with the samples of the targets.
    void draw(gpu::Pipeline& pipeline, const FrameTargets& targets, const MsaaTexture& depth) const;
    bool isOn() const { return size_.x > 0; }
    void bindResult() const;
    std::size_t gpuBytes() const { return between_.texture.sizeBytes() + result_.texture.sizeBytes(); }

  private:
    FullscreenPass alongX_, alongY_;
    gpu::Sampler smooth_;
    ColorTarget between_, result_;
    glm::ivec2 size_{0};
};

}  // namespace terrane::render
