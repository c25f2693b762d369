// The depth of the world near the camera as the sun or moon sees it. Used by the renderer on the context's
// thread.
#pragma once

#include "terrane/gpu/framebuffer.h"
#include "terrane/gpu/sampler.h"
#include "terrane/render/quad_draw.h"
#include "terrane/render/shader_variants.h"

namespace terrane::render {

class ShadowMap {
  public:
    ShadowMap() = default;
    explicit ShadowMap(const gpu::ShaderLoader& shaders);

    // Texels a side; 0: none.
    base::Result<void> configure(int size, bool hasFaceSampling);
    int size() const { return depth_.size().x; }
    // Draws what is culled for shadows, with the frame's uniforms bound.
    void draw(gpu::Pipeline& pipeline, const QuadDraw& quads) const;
    void bind() const;
    std::size_t gpuBytes() const { return depth_.sizeBytes(); }

  private:
    ShaderVariants opaque_, tested_;
    gpu::Texture2D depth_;
    gpu::Framebuffer framebuffer_;
    gpu::Sampler sampler_;
};

}  // namespace terrane::render
