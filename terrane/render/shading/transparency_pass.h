// Transparency: blended faces, separated into layers from the nearest on by depth peeling, then lit and
// blended over the image. Used by the renderer on the context's thread.
#pragma once

#include <array>
#include <span>

#include "terrane/render/cull/cull_pass.h"
#include "terrane/render/cull/screen_rect.h"
#include "terrane/render/effects/ambient_occlusion.h"
#include "terrane/render/frame/frame_targets.h"
#include "terrane/render/frame/fullscreen_pass.h"
#include "terrane/render/frame/render_options.h"
#include "terrane/render/shading/shading_pass.h"

namespace terrane::render {

class TransparencyPass {
  public:
    static constexpr int kMaxLayers = 3;

    TransparencyPass() = default;
    explicit TransparencyPass(const gpu::ShaderLoader& shaders);

    // Allocates the layers. Comes again when the targets change.
    base::Result<void> configure(const FrameTargets& targets, const RenderOptions& options,
                                 const LightVariant& light, const QuadFeatures& features);

    // Draws the layers into textures of its own, in front of the depth in `targets`. Only within `rects`,
    // which contain all pixels with blended faces and do not overlap; there is at least one.
    void peelLayers(gpu::Pipeline& pipeline, const FrameTargets& targets, const QuadDraw& quads,
                    std::span<const ScreenRect> rects);
    // Shades the layers of the same quads over the scene, if there are any.
    void shade(gpu::Pipeline& pipeline, const FrameTargets& targets, const QuadDraw& quads,
               const ShadingInputs& inputs, const AmbientOcclusion& occlusion,
               std::span<const ScreenRect> rects) const;

    // After peelLayers(): depth of the nearest surface in each sample, opaque or blended. Complete with
    // ambient occlusion or depth of field, which read it beside the layers; else within the rectangles.
    const MsaaTexture& nearestDepth() const { return targets_[0].depth; }
    std::size_t gpuBytes() const;

  private:
    struct Target {
        MsaaTexture color, depth;
        gpu::Framebuffer framebuffer;
    };
    static base::Result<Target> makeTarget(const FrameTargets& targets);
    void peelLayer(gpu::Pipeline& pipeline, const QuadDraw& quads, int number);
    void copyDepth(const FrameTargets& targets, int number, std::span<const ScreenRect> rects) const;
    void shadeWithin(gpu::Pipeline& pipeline, const FrameTargets& targets, const ScreenRect& rect,
                     const ShadingInputs& inputs, const AmbientOcclusion& occlusion) const;
    void bindLayers() const;

    base::Result<void> selectVariants(int samples, const RenderOptions& options, const LightVariant& light,
                                      const QuadFeatures& features);

    ShaderVariants first_, next_;
    std::array<ShaderVariants, 2> shadeQuads_;  // in air, under water
    std::array<FullscreenPass, 2> shade_;
    PixelMask mask_;
    bool shadesQuads_ = false;    // instead of the whole screen
    bool isDirect_ = false;       // see frame_targets.h
    bool isMasked_ = false;       // the whole screen except pixels without layers
    bool isBounded_ = true;       // by rectangles: a single layer has a background everywhere
    bool hasWholeDepth_ = false;  // other passes read the first layer's depth all over the screen
    gpu::Framebuffer overQuads_, overQuadsDirect_;  // the scene, the LDR target with the first layer's depth
    int layers_ = 0;
    glm::ivec2 size_{0};
    int samples_ = 0;
    GLuint scene_ = 0;  // of the targets it was made for
    std::array<Target, kMaxLayers> targets_;
    std::array<gpu::Handle<gpu::ObjectKind::Query>, kMaxLayers> anyDrawn_;
};

}  // namespace terrane::render
