// Draws opaque and alpha-tested quads into the G-buffer. Used by the renderer on the context's thread.
#pragma once

#include "terrane/render/cull_pass.h"
#include "terrane/render/shader_variants.h"

namespace terrane::render {

class GBufferPass {
  public:
    GBufferPass() = default;
    explicit GBufferPass(const gpu::ShaderLoader& shaders);

    // alphaSamples: at how many places of a pixel holes are tested; 1: in its middle.
    // isSmooth: textures are filtered.
    base::Result<void> select(int alphaSamples, bool isSmooth);
    // Into the bound framebuffer, with the quads and the frame's uniforms bound.
    void draw(const CullPass& culled) const;

  private:
    ShaderVariants opaque_, tested_;
};

}  // namespace terrane::render
