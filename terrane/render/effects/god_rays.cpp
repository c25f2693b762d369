// Rays of the sun or moon between objects in front of it, in screen space, from the scene's coverage; at a
// third of the size.
#include "terrane/render/frame/frame.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {

MaybePass makeGodRays(FrameBuilder& build) {
    if (!build.options().godRays) return std::nullopt;
    const auto* sample = TERRANE_TRY(build.programs.fullscreen("effects/god_rays"));
    const auto* smooth = TERRANE_TRY(build.programs.fullscreen("effects/god_rays_smooth"));
    const glm::ivec2 size = (build.frame.spec.size + 2) / 3;
    const auto sampled = TERRANE_TRY(build.drawnTarget("sampled god rays", GL_R8, size));
    const auto smoothed = TERRANE_TRY(build.drawnTarget("god rays", GL_R8, size));
    const TargetRef scene = build.frame.targets.scene;
    build.frame.targets.godRays = smoothed.target;
    const auto nearest = std::make_shared<gpu::Sampler>(
        gpu::SamplerSettings{.minFilter = GL_NEAREST, .magFilter = GL_NEAREST}, "nearest");
    const auto linear = std::make_shared<gpu::Sampler>(gpu::SamplerSettings{}, "smooth");
    return Pass{.reads = {scene}, .writes = {smoothed.target}, .record = [=](FrameContext& context) {
                    sampled.framebuffer->bind();
                    drawFullscreen(context, *sample, {},
                                   gpu::TextureSet().add(shared::kSceneUnit, scene->id(), nearest.get()));
                    smoothed.framebuffer->bind();
                    drawFullscreen(
                        context, *smooth, {},
                        gpu::TextureSet().add(shared::kSceneUnit, sampled.target->id(), linear.get()));
                }};
}

}  // namespace terrane::render
