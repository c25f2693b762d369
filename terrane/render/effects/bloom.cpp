// Bloom: light that is brighter than the screen can show spreads around lamps, crystals and the sun. It is
// collected at a quarter of the size, halved a few times, and added up again from the smallest image to the
// largest.
#include <array>

#include "terrane/render/frame/frame.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {
namespace {

constexpr int kBloomImages = 6;   // each half as large as the one before
constexpr int kBloomDivisor = 4;  // of the size, for the first

}  // namespace

MaybePass makeBloom(FrameBuilder& build) {
    if (!build.options().bloom) return std::nullopt;
    const auto* collect = TERRANE_TRY(build.programs.fullscreen("effects/bloom_collect"));
    const auto* halve = TERRANE_TRY(build.programs.fullscreen("effects/bloom_halve"));
    const auto* add = TERRANE_TRY(build.programs.fullscreen("effects/bloom_add"));
    std::array<FrameBuilder::Drawn, kBloomImages> images, sums;
    for (std::size_t k = 0; k < kBloomImages; ++k) {
        const int divisor = kBloomDivisor << k;
        const glm::ivec2 size = (build.frame.spec.size + divisor - 1) / divisor;
        images[k] = TERRANE_TRY(build.drawnTarget("bright light", GL_R11F_G11F_B10F, size));
        if (k + 1 < kBloomImages)
            sums[k] = TERRANE_TRY(build.drawnTarget("bloom", GL_R11F_G11F_B10F, size));
        else
            sums[k] = images[k];
    }
    const TargetRef scene = build.frame.targets.scene;
    build.frame.targets.bloom = sums[0].target;
    const auto smooth = std::make_shared<gpu::Sampler>(gpu::SamplerSettings{}, "smooth");
    return Pass{
        .reads = {scene}, .writes = {sums[0].target}, .record = [=](FrameContext& context) {
            const auto draw = [&](const FrameBuilder::Drawn& into, const gpu::Program& program,
                                  gpu::TextureSet textures) {
                into.framebuffer->bind();
                drawFullscreen(context, program, {}, textures);
            };
            const auto from = [&](const TargetRef& target) {
                return gpu::TextureSet().add(shared::kSceneUnit, target->id(), smooth.get());
            };
            draw(images[0], *collect, from(scene));
            for (std::size_t k = 1; k < kBloomImages; ++k)
                draw(images[k], *halve, from(images[k - 1].target));
            for (std::size_t k = kBloomImages - 1; k-- > 0;)
                draw(sums[k], *add,
                     from(images[k].target).add(shared::kBloomUnit, sums[k + 1].target->id(), smooth.get()));
        }};
}

}  // namespace terrane::render
