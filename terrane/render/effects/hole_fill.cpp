// Fills the cracks at T-junctions: holes of one sample in the G-buffer, between quads of different sizes,
// that show something farther. The method of D. Čejchan's thesis; with edge_expansion.glsl there are no
// holes. Reads a copy of the G-buffer: eight bytes a sample.
#include "terrane/render/frame/frame.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {

MaybePass makeHoleFill(FrameBuilder& build) {
    if (build.options().tJunctions != TJunctions::Filled) return std::nullopt;
    const int samples = build.samples();
    const auto* fill =
        TERRANE_TRY(build.programs.fullscreen("effects/hole_fill", HoleFillVariant{samples}.defines()));
    const glm::ivec2 size = build.frame.spec.size;
    const TargetRef surfaces = build.frame.targets.surfaces, depth = build.frame.targets.depth;
    const TargetRef oldSurfaces = build.target({"G-buffer with holes", GL_RGBA8, size, samples});
    const TargetRef oldDepth = build.target({"depth with holes", GL_DEPTH_COMPONENT32F, size, samples});
    return Pass{.reads = {surfaces, depth},
                .writes = {surfaces, depth},
                .record =
                    [=](FrameContext& context) {
                        copyTarget(*surfaces, *oldSurfaces, {0, 0}, size);
                        copyTarget(*depth, *oldDepth, {0, 0}, size);
                        context.frame.gbuffer->bind();
                        drawFullscreen(context, *fill,
                                       {.depthTest = gpu::DepthTest::Always, .readsSampleId = samples > 1},
                                       gpu::TextureSet()
                                           .add(shared::kGBufferUnit, oldSurfaces->id())
                                           .add(shared::kDepthUnit, oldDepth->id()));
                    },
                .drawnIn = DrawnIn::EveryView};
}

}  // namespace terrane::render
