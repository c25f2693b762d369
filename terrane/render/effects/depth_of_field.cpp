// Blurs distant objects, along both axes; at half the size.
#include "terrane/render/frame/frame.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {

MaybePass makeDepthOfField(FrameBuilder& build) {
    if (!build.options().depthOfField) return std::nullopt;
    const auto blurAlong = [&](const DepthOfFieldVariant& variant) {
        return build.programs.fullscreen("effects/depth_of_field", variant.defines());
    };
    const auto* alongX = TERRANE_TRY(blurAlong({build.samples(), Axis::X}));
    const auto* alongY = TERRANE_TRY(blurAlong({1, Axis::Y}));
    const glm::ivec2 size = (build.frame.spec.size + 1) / 2;
    const auto between = TERRANE_TRY(build.drawnTarget("blurred along x", GL_RGBA16F, size));
    const auto blurred = TERRANE_TRY(build.drawnTarget("blurred", GL_RGBA16F, size));
    const TargetRef scene = build.frame.targets.scene;
    build.frame.targets.depthOfField = blurred.target;
    const auto smooth = std::make_shared<gpu::Sampler>(gpu::SamplerSettings{}, "smooth");
    return Pass{.reads = {scene, build.frame.targets.depth},
                .writes = {blurred.target},
                .record = [=](FrameContext& context) {
                    between.framebuffer->bind();
                    drawFullscreen(context, *alongX, {},
                                   gpu::TextureSet()
                                       .add(shared::kDepthUnit, context.nearestDepth->id())
                                       .add(shared::kSceneUnit, scene->id()));
                    blurred.framebuffer->bind();
                    drawFullscreen(
                        context, *alongY, {},
                        gpu::TextureSet().add(shared::kDepthOfFieldUnit, between.target->id(), smooth.get()));
                }};
}

}  // namespace terrane::render
