// Transparency: blended faces, separated into layers from the nearest on by depth peeling, then lit and
// blended over the image. Used by the renderer on the context's thread.
#pragma once

#include <array>

#include "terrane/render/ambient_occlusion.h"
#include "terrane/render/frame_targets.h"
#include "terrane/render/fullscreen_pass.h"
#include "terrane/render/pixel_mask.h"
#include "terrane/render/quad_draw.h"
#include "terrane/render/render_options.h"
#include "terrane/render/shading_inputs.h"

namespace terrane::render {

class TransparencyPass {
  public:
    static constexpr int kMaxLayers = 3;

    TransparencyPass() = default;
    explicit TransparencyPass(const gpu::ShaderLoader& shaders);

    // Makes room for the layers. Comes again whenever the targets are others.
    base::Result<void> configure(const FrameTargets& targets, const RenderOptions& options, const LightVariant& light,
                                 const QuadFeatures& features);

    // Into textures of its own, behind nothing of the depth in `targets`.
    void peelLayers(gpu::Pipeline& pipeline, const FrameTargets& targets, const QuadDraw& quads);
    // Over the scene, where peel found anything. Of the same quads.
    void shade(gpu::Pipeline& pipeline, const FrameTargets& targets, const QuadDraw& quads,
               const ShadingInputs& inputs, const AmbientOcclusion& occlusion) const;

    // After peelLayers(): of what is nearest in each sample, opaque or blended.
    const MsaaTexture& nearestDepth() const { return targets_[0].depth; }
    std::size_t gpuBytes() const;

  private:
    struct Target {
        MsaaTexture color, depth;
        gpu::Framebuffer framebuffer;
    };
    static base::Result<Target> makeTarget(const FrameTargets& targets);
    void peelLayer(gpu::Pipeline& pipeline, const FrameTargets& targets, const QuadDraw& quads, int number);
    void bindLayers() const;

    base::Result<void> selectVariants(int samples, const RenderOptions& options, const LightVariant& light,
                                      const QuadFeatures& features);

    ShaderVariants first_, next_, shadeQuads_;
    FullscreenPass shade_;
    PixelMask mask_;
    bool shadesQuads_ = false;    // instead of the whole screen
    bool isDirect_ = false;       // see direct_image.h
    bool isMasked_ = false;       // the whole screen but for pixels without layers
    gpu::Framebuffer overQuads_, overQuadsDirect_;  // the scene, the LDR target with the first layer's depth
    int layers_ = 0;
    glm::ivec2 size_{0};
    int samples_ = 0;
    GLuint scene_ = 0;  // of the targets it was made for
    std::array<Target, kMaxLayers> targets_;
    std::array<gpu::Handle<gpu::ObjectKind::Query>, kMaxLayers> anyDrawn_;
};

}  // namespace terrane::render
