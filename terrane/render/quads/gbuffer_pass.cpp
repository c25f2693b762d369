// Draws opaque and alpha-tested quads into the G-buffer, or shaded at their corners into the image.
#include "terrane/render/corners/corners.h"
#include "terrane/render/frame/frame.h"
#include "terrane/render/rays/rays_pass.h"

namespace terrane::render {
namespace {

constexpr gpu::PipelineState kNearest{.depthTest = gpu::DepthTest::Greater};

// The quads that the last culling selected.
MaybePass makeQuads(FrameBuilder& build, bool isFirst) {
    const RenderOptions& options = build.options();
    const QuadFeatures& features = build.features();
    GBufferVariant variant{.isSmooth = options.sharpFiltering,
                           .hasFaceSampling = features.hasFaceSampling,
                           .hasTint = features.hasTint};
    const auto* opaque = TERRANE_TRY(build.programs.quads("quads/gbuffer", variant.defines()));
    variant.alphaClass = mesh::AlphaClass::Tested;
    variant.samples = options.msaaAlphaTest ? build.samples() : 1;
    const auto* tested = TERRANE_TRY(build.programs.quads("quads/gbuffer", variant.defines()));
    const auto opaqueCorners = TERRANE_TRY(makeCornerPrograms(build, mesh::AlphaClass::Opaque));
    const auto testedCorners = TERRANE_TRY(makeCornerPrograms(build, mesh::AlphaClass::Tested));
    const SharedTargets& targets = build.frame.targets;
    std::vector<TargetRef> writes = {targets.surfaces, targets.depth};
    if (opaqueCorners) writes.push_back(targets.image);
    return Pass{.writes = std::move(writes),
                .record =
                    [=](FrameContext& context) {
                        const bool atCorners = context.shadesAtCorners();
                        const gpu::Framebuffer& target =
                            atCorners ? *context.frame.direct : *context.frame.gbuffer;
                        context.pipeline.set(kNearest);
                        if (isFirst) {
                            if (!atCorners) target.clearColor(0, glm::vec4(1));
                            target.clearDepth(0.0f);
                        }
                        target.bind();
                        context.worldTextures.bind();
                        const QuadDraw quads = context.quadDraw();
                        quads.bind();
                        (atCorners ? opaqueCorners->of(context) : *opaque).use();
                        quads.draw(context.pipeline, kNearest, mesh::AlphaClass::Opaque);
                        (atCorners ? testedCorners->of(context) : *tested).use();
                        quads.draw(context.pipeline, kNearest, mesh::AlphaClass::Tested);
                    },
                .drawnIn = DrawnIn::EveryView};
}

}  // namespace

MaybePass makeSurfaces(FrameBuilder& build) {
    if (build.options().surfaces == SurfaceMethod::Rays) return makeRaySurfaces(build);
    return makeQuads(build, true);
}

MaybePass makeLateSurfaces(FrameBuilder& build) {
    if (!build.options().occlusionCulling) return std::nullopt;
    auto pass = TERRANE_TRY(makeQuads(build, false));
    pass->isNeeded = [](FrameContext& context) { return context.cullsOccluded(); };
    return pass;
}

}  // namespace terrane::render
