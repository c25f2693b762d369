// The shadow map within a frame.
#include "terrane/render/frame/frame.h"

namespace terrane::render {

MaybePass makeShadowMap(FrameBuilder& build) {
    if (!build.frame.shadowMap) return std::nullopt;
    const auto quads = [&](const ShadowVariant& variant) {
        return build.programs.quads("shadow/shadow", variant.defines());
    };
    ShadowPrograms programs{};
    programs.opaque = TERRANE_TRY(quads({mesh::AlphaClass::Opaque, false}));
    programs.tested = TERRANE_TRY(quads({mesh::AlphaClass::Tested, build.features().hasFaceSampling}));
    programs.figures = TERRANE_TRY(build.programs.graphics("figures/figure", "figures/figure_shadow",
                                                           FigureVariant{QuadPass::Shadows}.defines()));
    return Pass{
        .record =
            [programs](FrameContext& context) {
                const FrameInput& input = context.input;
                ShadowMap& map = *context.frame.shadowMap;
                map.update(context.pipeline, {context.resources, context.quads, context.meshSections},
                           programs, input.camera, input.environment.lightDirection, input.maxShadowTiles);
                const auto figures = figureRecords(input.figures, input.camera, {}, kFigureShadowReach);
                map.drawFigures(context.pipeline, context.figures, programs,
                                {figures, cameraChunk(input.camera)}, context.ring);
                map.writeUniforms(input.camera, true, context.ring);
            },
        .isNeeded = [](FrameContext& context) { return context.hasShadows; },
        .drawnIn = DrawnIn::EveryView};
}

}  // namespace terrane::render
