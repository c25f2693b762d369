// Shades the G-buffer over the sky, into the scene or directly into the image of the screen: see
// direct_image.h. Used by the renderer on the context's thread.
#pragma once

#include <array>

#include "terrane/base/result.h"
#include "terrane/render/ambient_occlusion.h"
#include "terrane/render/frame_targets.h"
#include "terrane/render/fullscreen_pass.h"
#include "terrane/render/pixel_mask.h"
#include "terrane/render/render_options.h"
#include "terrane/render/shading_inputs.h"

namespace terrane::render {

class ShadingPass {
  public:
    ShadingPass() = default;
    explicit ShadingPass(const gpu::ShaderLoader& shaders);

    base::Result<void> select(const RenderOptions& options, int samples, const LightVariant& sun);
    struct Sky {
        float fogDistance;  // blocks
        bool isNight;       // with stars, or the moon in place of the sun
    };
    // Draws the part of the sky that is visible, or that surfaces fade into.
    void drawSky(gpu::Pipeline& pipeline, const FrameTargets& targets, const ShadingInputs& inputs,
                 const Sky& sky) const;
    // Draws the surfaces, after the sky. `occlusion` is read if select() enabled it.
    void drawSurfaces(gpu::Pipeline& pipeline, const FrameTargets& targets, const ShadingInputs& inputs,
                      const AmbientOcclusion& occlusion) const;

  private:
    FullscreenPass sky_, nightSky_;
    std::array<FullscreenPass, 2> shade_;  // in air, under water
    FullscreenPass shadeDistant_;          // pixels beyond kSimpleLightFrom blocks, in air
    FullscreenPass shadeFar_;              // pixels of far tiles, in air
    PixelMask skyMask_, surfaceMask_;
    bool fadesOverSky_ = false, hasDistanceFog_ = false, isDirect_ = false, hasDistant_ = false;
};

}  // namespace terrane::render
