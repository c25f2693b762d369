#include "terrane/render/shading/shading_pass.h"

#include "terrane/render/frame/camera.h"
#include "terrane/render/frame/frame_targets.h"
#include "terrane/render/frame/shader_variants.h"
#include "terrane/shared/bindings.h"
#include "terrane/shared/frame.h"

namespace terrane::render {

base::Result<void> PixelMask::select(int samples) {
    return pass_.select(defined({{"MSAA_SAMPLES", samples}, {"OF", static_cast<int>(of_)}}));
}

void PixelMask::draw(gpu::Pipeline& pipeline, const FrameTargets& targets) const {
    const gpu::PipelineState nearest{.depthTest = gpu::DepthTest::Always, .depthRange = {1, 1}};
    pipeline.set(nearest);
    targets.bindGBuffer();
    targets.mask.bind();
    targets.mask.clearDepth(0.0f);
    pass_.draw(pipeline, nearest);
}

namespace {

constexpr int kSimpleLight = 2;       // see light_sample.glsl
constexpr float kSkyDistance = 1e6f;  // blocks: nothing but the sky is farther

}  // namespace

ShadingPass::ShadingPass(const gpu::ShaderLoader& shaders)
    : sky_(shaders, "sky/sky"),
      nightSky_(shaders, "sky/sky"),
      shade_{FullscreenPass(shaders, "shading/shade"), FullscreenPass(shaders, "shading/shade")},
      shadeDistant_(shaders, "shading/shade"),
      shadeFar_(shaders, "shading/shade"),
      skyMask_(shaders, PixelMask::Of::Sky),
      surfaceMask_(shaders, PixelMask::Of::Surfaces) {}

base::Result<void> ShadingPass::select(const RenderOptions& options, int samples, const LightVariant& sun) {
    fadesOverSky_ = samples > 1 || options.clouds;
    hasDistanceFog_ = options.distanceFog;
    isDirect_ = isDirectImage(options, samples);
    hasDistant_ = samples > 1 && options.light == LightSampling::Smooth;
    const auto sky = [&](int night) {
        return defined({{"CLOUDS", options.clouds}, {"NIGHT", night}, {"DIRECT", isDirect_}});
    };
    auto selected = sky_.select(sky(0));
    if (selected) selected = nightSky_.select(sky(1));
    if (selected && samples > 1) selected = skyMask_.select(samples);
    if (selected && samples > 1) selected = surfaceMask_.select(samples);
    const auto shade = [&](int light, int isUnderWater, int isFar) {
        return defined({{"MSAA_SAMPLES", samples},
                        {"PER_SAMPLE", options.shading != Shading::Pixel},
                        {"LIGHT_SMOOTH", light},
                        {"SHADOW", sun.shadowVariant},
                        {"LAND", sun.knowsLand},
                        {"OCCLUSION", options.occlusion != Occlusion::Off},
                        {"OVER_SKY", fadesOverSky_},
                        {"DIRECT", isDirect_},
                        {"UNDER_WATER", isUnderWater},
                        {"FAR", isFar}});
    };
    const int light = static_cast<int>(options.light);
    for (int isUnderWater = 0; selected && isUnderWater < 2; ++isUnderWater)
        selected = shade_[static_cast<std::size_t>(isUnderWater)].select(shade(light, isUnderWater, 0));
    if (selected && hasDistant_) selected = shadeDistant_.select(shade(kSimpleLight, 0, 0));
    if (selected && samples > 1) selected = shadeFar_.select(shade(0, 0, 1));
    return selected;
}

// Pixels are selected by the depth test: against the mask, or against the surfaces, with the triangle at the
// depth where they begin to fade.
void ShadingPass::drawSky(gpu::Pipeline& pipeline, const FrameTargets& targets, const ShadingInputs& inputs,
                          const Sky& sky) const {
    gpu::PipelineState state{.depthTest = gpu::DepthTest::Less, .writesDepth = false};
    if (targets.msaaSamples > 1) {
        skyMask_.draw(pipeline, targets);
    } else {
        const float distance =
            fadesOverSky_ && hasDistanceFog_ ? shared::kFadingBegins * sky.fogDistance : kSkyDistance;
        state.depthRange.x = kNearPlane / distance;
        state.depthTest = gpu::DepthTest::Greater;
    }
    inputs.bind();
    (isDirect_ ? targets.direct : targets.scene).bind();
    // By day a shader without stars and moon: software renderers run all branches.
    (sky.isNight ? nightSky_ : sky_).draw(pipeline, state);
}

// Pixels are selected by the depth test. With one sample a pixel the triangle is at the far end, and all
// surfaces are nearer. With more the mask is tested. It separates distant surfaces and far tiles, which in
// air have shaders of their own that read less light or none.
void ShadingPass::drawSurfaces(gpu::Pipeline& pipeline, const FrameTargets& targets,
                               const ShadingInputs& inputs, const AmbientOcclusion& occlusion) const {
    const bool isMasked = targets.msaaSamples > 1, drawsFar = isMasked && !inputs.isUnderWater;
    if (isMasked) surfaceMask_.draw(pipeline, targets);
    targets.bindGBuffer();
    inputs.bind();
    if (occlusion.isOn()) occlusion.result().bind(shared::kOcclusionUnit);
    (isDirect_ ? targets.direct : targets.scene).bind();
    gpu::PipelineState state{.depthTest = gpu::DepthTest::Less,
                             .writesDepth = false,
                             .blending = fadesOverSky_ ? gpu::Blending::Over : gpu::Blending::Off};
    if (drawsFar)
        state.depthRange.x = hasDistant_ ? shared::kDistantSurfacesDepth : shared::kFarSurfacesDepth;
    shade_[inputs.isUnderWater ? 1 : 0].draw(pipeline, state);
    if (!drawsFar) return;
    state.depthTest = gpu::DepthTest::Equal;
    if (hasDistant_) shadeDistant_.draw(pipeline, state);
    state.depthRange.x = shared::kFarSurfacesDepth;
    shadeFar_.draw(pipeline, state);
}

}  // namespace terrane::render
