// Draws opaque and alpha-tested quads into the G-buffer. Used by the renderer on the context's thread.
#pragma once

#include "terrane/render/cull/cull_pass.h"
#include "terrane/render/frame/frame_targets.h"
#include "terrane/render/frame/shader_variants.h"

namespace terrane::render {

class GBufferPass {
  public:
    GBufferPass() = default;
    explicit GBufferPass(const gpu::ShaderLoader& shaders);

    // alphaSamples: number of places in a pixel where holes are tested; 1: its center.
    // isSmooth: textures are filtered.
    base::Result<void> select(int alphaSamples, bool isSmooth, const QuadFeatures& features);
    // Empties the G-buffer.
    void clear(gpu::Pipeline& pipeline, const FrameTargets& targets) const;
    // Draws into the G-buffer, with the frame's uniforms bound.
    void draw(gpu::Pipeline& pipeline, const FrameTargets& targets, const QuadDraw& quads) const;

  private:
    ShaderVariants opaque_, tested_;
};

}  // namespace terrane::render
