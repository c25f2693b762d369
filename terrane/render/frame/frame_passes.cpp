#include "terrane/render/frame/frame_passes.h"

namespace terrane::render {
namespace {

bool castsShadows(const RenderOptions& options) {
    return options.shadows != ShadowReach::Off && options.shading != Shading::Off;
}

ShadowMap::Shape shadowShape(const RenderOptions& options) {
    if (!castsShadows(options)) return {};
    const int cascades = options.shadows == ShadowReach::Near ? 1 : static_cast<int>(shared::kShadowCascades);
    return {cascades, options.shadowSize};
}

// SHADOW of shadow_sample.glsl.
int shadowVariant(const RenderOptions& options) {
    if (!castsShadows(options)) return 0;
    return options.softShadows ? 2 : 1;
}

}  // namespace

bool readsLand(const RenderOptions& options) {
    return castsShadows(options) && options.shadows == ShadowReach::Horizon;
}

base::Result<FramePasses> FramePasses::create(const gpu::ShaderLoader& shaders,
                                              const gpu::DeviceInfo& device) {
    auto cull = TERRANE_TRY(CullPass::create(shaders, device));
    return FramePasses{.cull = std::move(cull),
                       .hiZ = HiZ(shaders),
                       .shadowMap = ShadowMap(shaders),
                       .gbuffer = GBufferPass(shaders),
                       .holeFill = HoleFill(shaders),
                       .figures = FigurePass(shaders),
                       .transparency = TransparencyPass(shaders),
                       .occlusion = AmbientOcclusion(shaders),
                       .godRays = GodRays(shaders),
                       .depthOfField = DepthOfField(shaders),
                       .shading = ShadingPass(shaders),
                       .debugView = FullscreenPass(shaders, "frame/debug_view"),
                       .finalPass = FullscreenPass(shaders, "frame/final")};
}

base::Result<void> FramePasses::configure(const FrameTargets& targets, const RenderOptions& options,
                                          const QuadFeatures& features) {
    const int samples = targets.msaaSamples, light = static_cast<int>(options.light);
    const int shadows = shadowVariant(options);
    auto done = shadowMap.configure(shadowShape(options), features.hasFaceSampling);
    if (done) done = gbuffer.select(options.msaaAlphaTest ? samples : 1, options.sharpFiltering, features);
    if (done) done = holeFill.configure(targets, options.tJunctions == TJunctions::Filled);
    if (done) done = figures.select(castsShadows(options));
    const bool knowsLand = features.hasLand && readsLand(options);
    if (done) done = shading.select(options, samples, {shadows, knowsLand});
    if (done) done = transparency.configure(targets, options, {shadows, knowsLand}, features);
    if (done) done = debugView.select(defined({{"MSAA_SAMPLES", samples}, {"LIGHT_SMOOTH", light}}));
    if (done)
        done =
            occlusion.configure(targets, options.occlusion != Occlusion::Off, options.transparencyLayers > 0);
    if (done) done = godRays.configure(targets.size, options.godRays);
    if (done) done = depthOfField.configure(targets, options.depthOfField);
    if (done) {
        done = finalPass.select(defined({{"MSAA_SAMPLES", samples},
                                         {"DEPTH_OF_FIELD", options.depthOfField ? 1 : 0},
                                         {"GOD_RAYS", options.godRays ? 1 : 0},
                                         {"RAW_OCCLUSION", options.occlusion == Occlusion::Raw ? 1 : 0}}));
    }
    // hiZ comes last, since it keeps no programs of other options: if a pass before it fails, it is
    // unchanged.
    if (done) done = hiZ.configure(targets, options.occlusionCulling);
    return done;
}

std::size_t FramePasses::targetBytes() const {
    return hiZ.gpuBytes() + shadowMap.gpuBytes() + holeFill.gpuBytes() + transparency.gpuBytes() +
           occlusion.gpuBytes() + godRays.gpuBytes() + depthOfField.gpuBytes();
}

}  // namespace terrane::render
