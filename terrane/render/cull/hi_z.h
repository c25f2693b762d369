// Hi-Z: the farthest depths of squares of pixels in a mip chain, for occlusion culling. Used by the renderer
// on the context's thread.
#pragma once

#include "terrane/gpu/program.h"
#include "terrane/render/frame/frame_targets.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {

class HiZ {
  public:
    HiZ() = default;
    explicit HiZ(const gpu::ShaderLoader& shaders) : shaders_(&shaders) {}

    base::Result<void> configure(const FrameTargets& targets, bool isOn);
    bool isOn() const { return texture_.id() != 0; }
    int levels() const { return texture_.levels(); }

    void build(const FrameTargets& targets) const;
    void bind() const { texture_.bind(shared::kHiZUnit); }
    std::size_t gpuBytes() const { return texture_.sizeBytes(); }

  private:
    const gpu::ShaderLoader* shaders_ = nullptr;
    gpu::Program finest_, next_;
    int samples_ = 0;
    glm::ivec2 imageSize_{0};
    gpu::Texture2D texture_;
};

}  // namespace terrane::render
