#include "terrane/render/corners/corners.h"

namespace terrane::render {

base::Result<std::optional<CornerPrograms>> makeCornerPrograms(FrameBuilder& build,
                                                               mesh::AlphaClass alphaClass) {
    if (build.options().shading != Shading::Corners) return std::nullopt;
    CornerPrograms made;
    for (const bool isUnderWater : {false, true}) {
        const CornersVariant variant{alphaClass, build.features().hasTint, isUnderWater};
        made.inAirAndWater[isUnderWater ? 1 : 0] =
            TERRANE_TRY(build.programs.graphics("corners/corners", "corners/corners", variant.defines()));
    }
    return made;
}

MaybePass makeCornerLayers(FrameBuilder& build) {
    const auto programs = TERRANE_TRY(makeCornerPrograms(build, mesh::AlphaClass::Blended));
    const SharedTargets& targets = build.frame.targets;
    return Pass{
        .reads = {targets.depth}, .writes = {targets.image}, .record = [=](FrameContext& context) {
            context.frame.direct->bind();
            context.worldTextures.bind();
            const QuadDraw quads = context.quadDraw();
            quads.bind();
            programs->of(context).use();
            quads.draw(
                context.pipeline,
                {.depthTest = gpu::DepthTest::Greater, .writesDepth = false, .blending = gpu::Blending::Over},
                mesh::AlphaClass::Blended);
        }};
}

}  // namespace terrane::render
