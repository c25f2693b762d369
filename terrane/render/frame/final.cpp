// The last pass of a frame: effects and display colors, or the G-buffer for debug views.
#include "terrane/render/frame/frame.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {

MaybePass makeFinal(FrameBuilder& build) {
    if (build.frame.isDirect()) return std::nullopt;
    const RenderOptions& options = build.options();
    const FinalVariant variant{build.samples(), options.depthOfField, options.godRays, options.bloom,
                               options.occlusion == Occlusion::Raw};
    const auto* final = TERRANE_TRY(build.programs.fullscreen("frame/final", variant.defines()));
    const SharedTargets& targets = build.frame.targets;
    const auto smooth = std::make_shared<gpu::Sampler>(gpu::SamplerSettings{}, "smooth");
    gpu::TextureSet textures;
    textures.add(shared::kSceneUnit, targets.scene->id());
    std::vector<TargetRef> reads = {targets.scene, targets.depth};
    const auto readIf = [&](const TargetRef& target, GLuint unit, const gpu::Sampler* sampler) {
        if (!target) return;
        textures.add(unit, target->id(), sampler);
        reads.push_back(target);
    };
    readIf(targets.occlusion, shared::kOcclusionUnit, nullptr);
    readIf(targets.bloom, shared::kBloomUnit, smooth.get());
    readIf(targets.godRays, shared::kGodRaysUnit, smooth.get());
    readIf(targets.depthOfField, shared::kDepthOfFieldUnit, smooth.get());
    return Pass{.reads = std::move(reads), .writes = {targets.image}, .record = [=](FrameContext& context) {
                    (void)smooth;  // lives as long as the pass
                    context.frame.image->bind();
                    drawFullscreen(
                        context, *final, {},
                        gpu::TextureSet(textures).add(shared::kDepthUnit, context.nearestDepth->id()));
                }};
}

MaybePass makeDebugView(FrameBuilder& build) {
    const LightDetail light =
        build.options().light == LightSampling::Smooth ? LightDetail::Smooth : LightDetail::Classic;
    const auto* show = TERRANE_TRY(
        build.programs.fullscreen("frame/debug_view", DebugViewVariant{build.samples(), light}.defines()));
    const SharedTargets& targets = build.frame.targets;
    return Pass{.reads = {targets.surfaces, targets.depth},
                .writes = {targets.image},
                .record =
                    [show](FrameContext& context) {
                        context.frame.image->bind();
                        drawFullscreen(context, *show, {},
                                       context.shadingTextures().add(context.frame.gbufferTextures()));
                    },
                .drawnIn = DrawnIn::DebugViews};
}

}  // namespace terrane::render
