// The sky with Shading::Corners: by day it is computed at the corners of a grid over the screen, and for each
// pixel only around the sun.
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "terrane/render/corners/corners.h"
#include "terrane/shared/constants.h"

namespace terrane::render {
namespace {

// The grid is too coarse for the glow around the sun or moon: the sky is computed for each pixel so far from
// it. In blocks on the image plane, one block ahead, in the middle of the image; that is 11°.
constexpr float kGlow = 0.2f;

static_assert(shared::kSkyGridVertices == 6 * shared::kSkyGridColumns * shared::kSkyGridRows);

// The pixels of the sun or moon and of the glow around it; empty if they are not in view.
ScreenRect glowRect(const FrameContext& context) {
    const ViewMatrices& view = context.view;
    const glm::vec3 light = context.input.environment.lightDirection;
    const float ahead = glm::dot(light, view.ahead) / glm::dot(view.ahead, view.ahead);
    if (ahead < 0.05f) return {};
    const glm::vec3 at = light / ahead - view.ahead;
    const glm::vec2 screen(glm::dot(at, view.across) / glm::dot(view.across, view.across),
                           glm::dot(at, view.up) / glm::dot(view.up, view.up));
    const glm::vec2 size(context.frame.spec.size);
    // Angles are wider aside.
    const float glow = kGlow * (1 + glm::dot(at, at));
    const glm::vec2 reach(glow / glm::length(view.across), glow / glm::length(view.up));
    const auto pixel = [&](glm::vec2 place) {
        return glm::ivec2(glm::clamp((0.5f + 0.5f * place) * size, glm::vec2(0), size));
    };
    return {pixel(screen - reach), pixel(screen + reach)};
}

}  // namespace

// At night all pixels are computed, for the stars.
MaybePass makeCornerSky(FrameBuilder& build) {
    std::array<const gpu::Program*, 2> grid{};
    for (const bool isUnderWater : {false, true})
        grid[isUnderWater ? 1 : 0] = TERRANE_TRY(build.programs.graphics(
            "corners/corner_sky", "corners/corner_sky", CornerSkyVariant{isUnderWater}.defines()));
    const auto* day =
        TERRANE_TRY(build.programs.fullscreen("sky/sky", SkyVariant{.isDirect = true}.defines()));
    const auto* night = TERRANE_TRY(
        build.programs.fullscreen("sky/sky", SkyVariant{.isNight = true, .isDirect = true}.defines()));
    const SharedTargets& targets = build.frame.targets;
    return Pass{.reads = {targets.depth}, .writes = {targets.image}, .record = [=](FrameContext& context) {
                    const world::Environment& environment = context.input.environment;
                    const gpu::PipelineState behind{.depthTest = gpu::DepthTest::Greater,
                                                    .writesDepth = false,
                                                    .depthRange = {kBehindAll, 1}};
                    const gpu::TextureSet textures = context.shadingTextures();
                    context.frame.direct->bind();
                    if (environment.starLight > 0 || environment.isMoon)
                        return drawFullscreen(context, *night, behind, textures);
                    context.pipeline.set(behind);
                    textures.bind();
                    grid[context.isUnderWater() ? 1 : 0]->use();
                    context.fullscreen.bind();
                    glDrawArrays(GL_TRIANGLES, 0, shared::kSkyGridVertices);
                    const ScreenRect glow = glowRect(context);
                    if (!glow.isEmpty()) drawFullscreen(context, *day, behind, textures, {&glow, 1});
                }};
}

}  // namespace terrane::render
