// Draws what the camera sees by rays: surfaces into the G-buffer, blended faces into layers. The passes after
// them do not know the difference.
#include "terrane/render/rays/rays_pass.h"

#include "terrane/render/rays/ray_store.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {
namespace {

base::Result<const gpu::Program*> rayProgram(FrameBuilder& build, RayLayer layer) {
    const QuadFeatures& features = build.features();
    const RayVariant variant{.layer = layer,
                             .samples = build.samples(),
                             .isSmooth = layer != RayLayer::Surfaces || build.options().sharpFiltering,
                             .hasFaceSampling = features.hasFaceSampling,
                             .hasTint = features.hasTint};
    return build.programs.fullscreen("rays/rays", variant.defines());
}

void drawRays(FrameContext& context, const gpu::Program& program, bool isBlended,
              const gpu::TextureSet& textures) {
    context.worldTextures.bind();
    bindRays(context, isBlended);
    drawFullscreen(context, program,
                   {.depthTest = gpu::DepthTest::Greater, .readsSampleId = context.frame.samples > 1},
                   textures);
}

}  // namespace

void bindRays(FrameContext& context, bool isBlended) {
    context.resources.bindTables();
    context.resources.bindTextures(context.frame.drawn.sharpFiltering);
    context.rays.bind(isBlended);
}

MaybePass makeRaySurfaces(FrameBuilder& build) {
    const auto* program = TERRANE_TRY(rayProgram(build, RayLayer::Surfaces));
    const SharedTargets& targets = build.frame.targets;
    return Pass{.writes = {targets.surfaces, targets.depth},
                .record =
                    [=](FrameContext& context) {
                        const gpu::Framebuffer& target = *context.frame.gbuffer;
                        context.pipeline.set({.depthTest = gpu::DepthTest::Greater});
                        target.clearColor(0, glm::vec4(1));
                        target.clearDepth(0.0f);
                        target.bind();
                        drawRays(context, *program, false, {});
                    },
                .drawnIn = DrawnIn::EveryView};
}

base::Result<RayLayerPrograms> RayLayerPrograms::make(FrameBuilder& build) {
    RayLayerPrograms programs;
    programs.first = TERRANE_TRY(rayProgram(build, RayLayer::First));
    if (build.options().transparencyLayers > 1)
        programs.next = TERRANE_TRY(rayProgram(build, RayLayer::Next));
    return programs;
}

void RayLayerPrograms::draw(FrameContext& context, const Target* before) const {
    gpu::TextureSet textures;
    textures.add(shared::kDepthUnit, context.frame.targets.depth->id());
    if (before) textures.add(shared::kTransparencyDepthUnit, before->id());
    drawRays(context, before ? *next : *first, true, textures);
}

}  // namespace terrane::render
