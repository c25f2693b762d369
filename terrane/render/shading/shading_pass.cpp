// Shades the G-buffer over the sky, into the scene or directly into the image of the screen: see
// isDirectImage().
#include <algorithm>
#include <array>

#include "terrane/render/corners/corners.h"
#include "terrane/render/frame/frame.h"
#include "terrane/render/rays/rays_pass.h"
#include "terrane/render/shading/pixel_mask.h"
#include "terrane/shared/bindings.h"
#include "terrane/shared/frame.h"

namespace terrane::render {

base::Result<PixelMask> PixelMask::make(FrameBuilder& build, MaskOf of) {
    if (build.samples() == 1) return PixelMask();
    const auto* program = TERRANE_TRY(
        build.programs.fullscreen("shading/pixel_mask", MaskVariant{build.samples(), of}.defines()));
    return PixelMask{program};
}

void PixelMask::draw(FrameContext& context, const gpu::TextureSet& textures,
                     std::span<const ScreenRect> within) const {
    const gpu::PipelineState nearest{.depthTest = gpu::DepthTest::Always, .depthRange = {1, 1}};
    context.pipeline.set(nearest);
    context.frame.mask->bind();
    if (within.empty()) context.frame.mask->clearDepth(0.0f);
    for (const ScreenRect& rect : within) {
        const gpu::Scissor scissor(rect.min, rect.size());
        context.frame.mask->clearDepth(0.0f);
    }
    drawFullscreen(context, *program, nearest, context.frame.gbufferTextures().add(textures), within);
}

namespace {

// Surfaces fade into the sky, which is drawn behind them first.
bool fadesOverSky(const FrameBuilder& build) {
    return build.samples() > 1 || build.options().clouds;
}

// What sky and surfaces are drawn into.
TargetRef shadedTarget(const FrameBuilder& build) {
    return build.frame.isDirect() ? build.frame.targets.image : build.frame.targets.scene;
}

const gpu::Framebuffer& shadedFramebuffer(const FrameContext& context) {
    return context.frame.isDirect() ? *context.frame.direct : *context.frame.scene;
}

// In air and under water, and in air distant pixels and those of far tiles.
struct ShadePrograms {
    std::array<const gpu::Program*, 2> shade{};
    const gpu::Program *distant = nullptr, *far = nullptr;
};

base::Result<ShadePrograms> makeShadePrograms(FrameBuilder& build) {
    const RenderOptions& options = build.options();
    const ShadeVariant inAir{
        .samples = build.samples(),
        .isPerSample = options.shading != Shading::Pixel,
        .hasOcclusion = options.occlusion != Occlusion::Off,
        .isOverSky = fadesOverSky(build),
        .isDirect = build.frame.isDirect(),
        .light = options.light == LightSampling::Smooth ? LightDetail::Smooth : LightDetail::Classic,
        .sun = SunVariant::of(options, build.features())};
    const auto program = [&](const ShadeVariant& variant) {
        return build.programs.fullscreen("shading/shade", variant.defines());
    };
    ShadeVariant underWater = inAir, distant = inAir, far = inAir;
    underWater.isUnderWater = true;
    distant.light = LightDetail::Simple;
    far.light = LightDetail::Classic;
    far.isFar = true;
    ShadePrograms made;
    made.shade[0] = TERRANE_TRY(program(inAir));
    made.shade[1] = TERRANE_TRY(program(underWater));
    if (build.samples() > 1 && inAir.light == LightDetail::Smooth)
        made.distant = TERRANE_TRY(program(distant));
    if (build.samples() > 1) made.far = TERRANE_TRY(program(far));
    return made;
}

}  // namespace

// Pixels are selected by the depth test: against the mask, or against the surfaces, with the triangle at the
// depth where they begin to fade.
MaybePass makeSky(FrameBuilder& build) {
    const RenderOptions& options = build.options();
    if (options.shading == Shading::Corners) return makeCornerSky(build);
    SkyVariant variant{.hasClouds = options.clouds, .isDirect = build.frame.isDirect()};
    const auto* day = TERRANE_TRY(build.programs.fullscreen("sky/sky", variant.defines()));
    variant.isNight = true;
    const auto* night = TERRANE_TRY(build.programs.fullscreen("sky/sky", variant.defines()));
    const PixelMask mask = TERRANE_TRY(PixelMask::make(build, MaskOf::Sky));
    const bool fades = fadesOverSky(build) && options.distanceFog;
    return Pass{.reads = {build.frame.targets.depth},
                .writes = {shadedTarget(build)},
                .record = [=](FrameContext& context) {
                    const FrameInput& input = context.input;
                    gpu::PipelineState state{.depthTest = gpu::DepthTest::Less, .writesDepth = false};
                    if (mask.program) {
                        mask.draw(context);
                    } else {
                        state.depthRange.x =
                            fades ? kNearPlane / (shared::kFadingBegins * input.fogDistance) : kBehindAll;
                        state.depthTest = gpu::DepthTest::Greater;
                    }
                    // By day a shader without stars and moon: software renderers run all branches.
                    const bool isNight = input.environment.starLight > 0 || input.environment.isMoon;
                    shadedFramebuffer(context).bind();
                    drawFullscreen(context, isNight ? *night : *day, state, context.shadingTextures());
                }};
}

// Pixels are selected by the depth test. With one sample a pixel the triangle is at the far end, and all
// surfaces are nearer. With more the mask is tested. It separates distant surfaces and far tiles, which in
// air have shaders of their own that read less light or none.
MaybePass makeShade(FrameBuilder& build) {
    if (build.options().shading == Shading::Corners) return std::nullopt;
    const ShadePrograms programs = TERRANE_TRY(makeShadePrograms(build));
    const PixelMask mask = TERRANE_TRY(PixelMask::make(build, MaskOf::Surfaces));
    const SharedTargets& targets = build.frame.targets;
    const TargetRef occlusion = targets.occlusion;
    const bool castsRays = SunVariant::of(build.options(), build.features()).shadows == ShadowEdges::Rays;
    const gpu::Blending blending = fadesOverSky(build) ? gpu::Blending::Over : gpu::Blending::Off;
    std::vector<TargetRef> reads = {targets.surfaces, targets.depth};
    if (occlusion) reads.push_back(occlusion);
    return Pass{
        .reads = std::move(reads), .writes = {shadedTarget(build)}, .record = [=](FrameContext& context) {
            const bool drawsFar = mask.program && !context.isUnderWater();
            if (mask.program) mask.draw(context);
            gpu::TextureSet textures = context.shadingTextures().add(context.frame.gbufferTextures());
            if (occlusion) textures.add(shared::kOcclusionUnit, occlusion->id());
            gpu::PipelineState state{
                .depthTest = gpu::DepthTest::Less, .writesDepth = false, .blending = blending};
            if (drawsFar)
                state.depthRange.x =
                    programs.distant ? shared::kDistantSurfacesDepth : shared::kFarSurfacesDepth;
            if (castsRays) bindRays(context, false);
            shadedFramebuffer(context).bind();
            drawFullscreen(context, *programs.shade[context.isUnderWater() ? 1 : 0], state, textures);
            if (!drawsFar) return;
            state.depthTest = gpu::DepthTest::Equal;
            if (programs.distant) drawFullscreen(context, *programs.distant, state, textures);
            state.depthRange.x = shared::kFarSurfacesDepth;
            drawFullscreen(context, *programs.far, state, textures);
        }};
}

// Clouds are drawn with the sky where nothing is behind them: see clouds.frag.glsl.
MaybePass makeClouds(FrameBuilder& build) {
    if (!build.options().clouds) return std::nullopt;
    const auto* program =
        TERRANE_TRY(build.programs.fullscreen("sky/clouds", CloudVariant{build.samples()}.defines()));
    return Pass{.reads = {build.frame.targets.depth},
                .writes = {build.frame.targets.scene},
                .record =
                    [=](FrameContext& context) {
                        const gpu::PipelineState over{.depthTest = gpu::DepthTest::Always,
                                                      .writesDepth = false,
                                                      .blending = gpu::Blending::Over};
                        context.frame.scene->bind();
                        drawFullscreen(context, *program, over,
                                       context.shadingTextures().add(context.frame.gbufferTextures()));
                    },
                .isNeeded =
                    [](FrameContext& context) {
                        const float highest =
                            std::max(context.view.cameraPosition.z, static_cast<float>(context.top));
                        return !context.isUnderWater() && highest > context.cloudsZ - shared::kCloudDepth;
                    }};
}

}  // namespace terrane::render
