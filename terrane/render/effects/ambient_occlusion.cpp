#include "terrane/render/effects/ambient_occlusion.h"

#include "terrane/render/frame/frame.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {

base::Result<OcclusionPrograms> OcclusionPrograms::make(FrameBuilder& build, bool isNearestLayer) {
    const OcclusionVariant variant{build.samples(), isNearestLayer};
    const auto blur = [&](Axis axis) {
        return build.programs.fullscreen("effects/occlusion_blur",
                                         OcclusionBlurVariant{variant, axis}.defines());
    };
    OcclusionPrograms made{};
    made.find = TERRANE_TRY(build.programs.fullscreen("effects/ambient_occlusion", variant.defines()));
    made.alongX = TERRANE_TRY(blur(Axis::X));
    made.alongY = TERRANE_TRY(blur(Axis::Y));
    const auto targetNamed = [&](std::string_view label,
                                 const TargetRef& there) -> base::Result<FrameBuilder::Drawn> {
        if (!there) return build.drawnTarget(label, GL_R8, build.frame.spec.size);
        const auto framebuffer = TERRANE_TRY(build.framebuffer(label, {there}));
        return FrameBuilder::Drawn{there, framebuffer};
    };
    SharedTargets& targets = build.frame.targets;
    made.visibility = TERRANE_TRY(targetNamed("ambient occlusion", targets.occlusion));
    made.between = TERRANE_TRY(targetNamed("occlusion between", targets.occlusionBetween));
    targets.occlusion = made.visibility.target;
    targets.occlusionBetween = made.between.target;
    return made;
}

void OcclusionPrograms::draw(FrameContext& context, const gpu::TextureSet& textures) const {
    visibility.framebuffer->bind();
    drawFullscreen(context, *find, {}, textures);
    between.framebuffer->bind();
    drawFullscreen(context, *alongX, {},
                   gpu::TextureSet(textures).add(shared::kOcclusionUnit, visibility.target->id()));
    visibility.framebuffer->bind();
    drawFullscreen(context, *alongY, {},
                   gpu::TextureSet(textures).add(shared::kOcclusionUnit, between.target->id()));
}

MaybePass makeOcclusion(FrameBuilder& build) {
    if (build.options().occlusion == Occlusion::Off) return std::nullopt;
    const auto programs = TERRANE_TRY(OcclusionPrograms::make(build, false));
    const SharedTargets& targets = build.frame.targets;
    return Pass{.reads = {targets.surfaces, targets.depth},
                .writes = {targets.occlusion},
                .record = [programs](FrameContext& context) {
                    programs.draw(context, context.frame.gbufferTextures());
                }};
}

}  // namespace terrane::render
