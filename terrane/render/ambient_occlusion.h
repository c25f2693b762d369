// Ambient occlusion in screen space, for the shading of surfaces. Used by the renderer on the context's
// thread.
#pragma once

#include "terrane/render/frame_targets.h"
#include "terrane/render/fullscreen_pass.h"

namespace terrane::render {

class AmbientOcclusion {
  public:
    AmbientOcclusion() = default;
    explicit AmbientOcclusion(const gpu::ShaderLoader& shaders);

    base::Result<void> configure(const FrameTargets& targets, bool isOn);
    void draw(gpu::Pipeline& pipeline, const FrameTargets& targets) const;
    bool isOn() const { return size_.x > 0; }
    const gpu::Texture2D& result() const {
        return visibility_.texture;
    }  // 1 where nothing shuts a surface in

  private:
    FullscreenPass find_, alongX_, alongY_;
    ColorTarget visibility_, between_;
    glm::ivec2 size_{0};
};

}  // namespace terrane::render
