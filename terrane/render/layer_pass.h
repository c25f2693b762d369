// Blended faces, peeled into layers from the nearest on, then lit and laid over the picture. Used by the
// renderer on the context's thread.
#pragma once

#include <array>

#include "terrane/render/cull_pass.h"
#include "terrane/render/frame_targets.h"
#include "terrane/render/fullscreen_pass.h"

namespace terrane::render {

class LayerPass {
  public:
    static constexpr int kMaxLayers = 3;

    LayerPass() = default;
    explicit LayerPass(const gpu::ShaderLoader& shaders);

    // Makes room for `layers` of the targets' size and samples. `shading`: defines SHADOW and LIGHT_SMOOTH.
    base::Result<void> configure(const FrameTargets& targets, int layers, gpu::ShaderDefines shading);

    // Into textures of its own, behind nothing of the depth in `targets`. With the quads bound.
    void peel(const FrameTargets& targets, const CullPass& culled);
    // Over the bound framebuffer, where peel found anything.
    void shade() const;

  private:
    struct Target {
        SampledTexture color, depth;
        gpu::Framebuffer framebuffer;
    };
    static base::Result<Target> makeTarget(const FrameTargets& targets);
    void drawLayer(const FrameTargets& targets, const CullPass& culled, int number);

    ShaderVariants first_, next_;
    FullscreenPass shade_;
    int layers_ = 0;
    glm::ivec2 size_{0};
    int samples_ = 0;
    std::array<Target, kMaxLayers> targets_;
    std::array<gpu::Handle<gpu::ObjectKind::Query>, kMaxLayers> anyDrawn_;
};

}  // namespace terrane::render
