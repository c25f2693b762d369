// A pass that covers the screen with one triangle: the sky, shading, the final image. Used by the renderer
// on the context's thread.
#pragma once

#include <string_view>

#include "terrane/gpu/pipeline_state.h"
#include "terrane/gpu/vertex_array.h"
#include "terrane/render/frame/shader_variants.h"

namespace terrane::render {

class FullscreenPass {
  public:
    FullscreenPass() = default;
    // The loader outlives the pass. The shader is terrane/render/NAME.frag.glsl, and NAME without its folder the label.
    FullscreenPass(const gpu::ShaderLoader& shaders, std::string_view name);

    base::Result<void> select(const gpu::ShaderDefines& defines) { return variants_.select(defines); }
    // Draws into the bound framebuffer, at depth 0 (farthest), with the inputs of the shader bound.
    void draw(gpu::Pipeline& pipeline, const gpu::PipelineState& state) const;

  private:
    ShaderVariants variants_;
    gpu::VertexArray vertexArray_;
};

}  // namespace terrane::render
