// Culling within a frame: everything in view at once, or with occlusion culling what was visible in the frame
// before, then what its depth does not hide.
#include "terrane/render/frame/frame.h"

namespace terrane::render {

MaybePass makeCull(FrameBuilder&) {
    return Pass{.record =
                    [](FrameContext& context) {
                        const CullPhase phase = context.hidesHidden() ? CullPhase::Early : CullPhase::All;
                        context.cull.run(phase, context.culling, context.meshSections, context.ring);
                    },
                .drawnIn = DrawnIn::EveryView};
}

MaybePass makeLateCull(FrameBuilder& build) {
    if (!build.options().occlusionCulling) return std::nullopt;
    return Pass{.reads = {build.frame.targets.hiZ},
                .record =
                    [](FrameContext& context) {
                        context.cull.run(CullPhase::Late, context.culling, context.meshSections,
                                         context.ring);
                    },
                .isNeeded = [](FrameContext& context) { return context.hidesHidden(); },
                .drawnIn = DrawnIn::EveryView};
}

}  // namespace terrane::render
