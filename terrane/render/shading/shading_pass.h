// Shades the G-buffer over the sky, into the scene or directly into the image of the screen: see
// frame_targets.h. Used by the renderer on the context's thread.
#pragma once

#include <array>

#include "terrane/base/result.h"
#include "terrane/render/effects/ambient_occlusion.h"
#include "terrane/render/frame/frame_targets.h"
#include "terrane/render/frame/fullscreen_pass.h"
#include "terrane/render/frame/render_options.h"
#include "terrane/render/quads/light_store.h"
#include "terrane/render/shadow/shadow_map.h"
#include "terrane/render/sky/sky_texture.h"

namespace terrane::render {

// Selects the pixels that a full-screen pass draws, for targets with several samples a pixel. The depth test
// rejects the others before the shader runs, whereas neighboring pixels would run a branch in the shader too.
// Used by passes on the context's thread.
class PixelMask {
  public:
    // Pixels in which any sample has a surface; shows the sky or may fade into it; has a layer.
    enum class Of { Surfaces, Sky, Layers };

    PixelMask() = default;
    PixelMask(const gpu::ShaderLoader& shaders, Of of) : pass_(shaders, "shading/pixel_mask"), of_(of) {}

    base::Result<void> select(int samples);
    // Draws the mask into the depth of the scene, with the textures of layers bound for Of::Layers: 1 in
    // these pixels and 0 in others; shared::kFarSurfacesDepth and kDistantSurfacesDepth if all surfaces of a
    // pixel are such.
    void draw(gpu::Pipeline& pipeline, const FrameTargets& targets) const;

  private:
    FullscreenPass pass_;
    Of of_ = Of::Surfaces;
};

// Inputs of shaders that light surfaces and layers, besides the G-buffer and the frame's uniforms. Used by
// the renderer on the context's thread.
// Defines of these shaders for light.
struct LightVariant {
    int shadowVariant = 0;   // SHADOW of shadow_sample.glsl; 0: none
    bool knowsLand = false;  // LAND of land_light.glsl
};

struct ShadingInputs {
    const LightStore& light;
    const ShadowMap& shadowMap;
    const SkyNoise& noise;
    bool isUnderWater = false;  // the camera; shaders have variants for it

    void bind() const {
        light.bind();
        if (shadowMap.isOn()) shadowMap.bind();
        noise.bind();
    }
};

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
