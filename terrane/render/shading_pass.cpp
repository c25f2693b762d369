#include "terrane/render/shading_pass.h"

#include "terrane/render/camera.h"
#include "terrane/render/shader_variants.h"
#include "terrane/shared/frame.h"

namespace terrane::render {
namespace {

constexpr float kSkyDistance = 1e6f;  // blocks: nothing but the sky is farther

}  // namespace

ShadingPass::ShadingPass(const gpu::ShaderLoader& shaders)
    : sky_(shaders, "sky"),
      shade_(shaders, "shade"),
      skyMask_(shaders, PixelMask::Of::Sky),
      surfaceMask_(shaders, PixelMask::Of::Surfaces) {}

base::Result<void> ShadingPass::select(const RenderOptions& options, int samples, bool hasShadows) {
    fadesOverSky_ = samples > 1 || options.clouds;
    hasAtmosphere_ = options.atmosphere;
    auto selected = sky_.select(defined({{"CLOUDS", options.clouds}}));
    if (selected && samples > 1) selected = skyMask_.select(samples);
    if (selected && samples > 1) selected = surfaceMask_.select(samples);
    if (!selected) return selected;
    return shade_.select(defined({{"SAMPLES", samples},
                                  {"PER_SAMPLE", options.shading != Shading::Pixel},
                                  {"LIGHT_SMOOTH", static_cast<int>(options.light)},
                                  {"SHADOW", hasShadows},
                                  {"OCCLUSION", options.occlusion != Occlusion::Off},
                                  {"OVER_SKY", fadesOverSky_}}));
}

// By the depth test: of the mask, or of surfaces, where the triangle lies where they begin to fade.
void ShadingPass::drawSky(const FrameTargets& targets, float fogDistance) const {
    if (targets.samples > 1) skyMask_.draw(targets);
    targets.scene.bind();
    glDepthMask(GL_FALSE);
    glEnable(GL_DEPTH_TEST);
    if (targets.samples > 1) {
        glDepthFunc(GL_LESS);
    } else {
        const bool isBehind = fadesOverSky_ && hasAtmosphere_;
        glDepthRangef(kNearPlane / (isBehind ? shared::kFadingBegins * fogDistance : kSkyDistance), 1.0f);
        glDepthFunc(GL_GREATER);
    }
    sky_.draw();
    glDepthRangef(0.0f, 1.0f);
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
}

// The triangle lies at the far end: surfaces are all nearer, and so is the mask.
void ShadingPass::drawSurfaces(const FrameTargets& targets) const {
    if (targets.samples > 1) surfaceMask_.draw(targets);
    targets.scene.bind();
    glDepthMask(GL_FALSE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    (fadesOverSky_ ? glEnable : glDisable)(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    shade_.draw();
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
}

}  // namespace terrane::render
