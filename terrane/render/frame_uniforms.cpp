#include "terrane/render/frame_uniforms.h"

#include <cmath>

#include "terrane/render/shadow_volume.h"

namespace terrane::render {
namespace {

constexpr float kAmbientFromBelow = 0.4f;  // share of the sky's light on faces that look down
constexpr float kExposure = 0.92f;

static_assert(static_cast<shared::uint>(View::Normal) == shared::kViewNormal &&
              static_cast<shared::uint>(View::Depth) == shared::kViewDepth &&
              static_cast<shared::uint>(View::Aggregation) == shared::kViewAggregation &&
              static_cast<shared::uint>(View::Light) == shared::kViewLight);

int switchesOf(const RenderOptions& o) {
    return (o.animation ? shared::kSwitchAnimation : 0) | (o.atmosphere ? shared::kSwitchAtmosphere : 0) |
           (o.shading == Shading::Off ? shared::kSwitchUnlit : 0);
}

void setEnvironment(shared::Frame& frame, const FrameInput& input) {
    const world::Environment& e = input.environment;
    frame.lightDirection = glm::vec4(e.lightDirection, input.timeSeconds);
    frame.lightColor = glm::vec4(e.lightColor, std::sin(e.discRadius));
    frame.ambientColor = glm::vec4(e.ambientColor, kAmbientFromBelow);
    frame.zenithColor = glm::vec4(e.zenithColor, kExposure);
    frame.horizonColor = glm::vec4(e.horizonColor, static_cast<float>(input.view));
    frame.glowColor = glm::vec4(e.glowColor, e.lampShare);
    frame.discColor = glm::vec4(e.discColor, e.starLight);
    frame.sky = {e.starTurn, e.isMoon ? 1 : 0, 0, 0};
}

// The light on the screen; behind the camera or far outside nothing of its rays is seen.
glm::vec4 lightOnScreen(const ViewMatrices& view, glm::vec3 direction) {
    const glm::vec4 p = view.viewProjection * glm::vec4(direction, 0);
    if (p.w <= 0.01f) return glm::vec4(0);
    const glm::vec2 at = glm::vec2(p) / p.w;
    const float outside = std::max(std::abs(at.x), std::abs(at.y)) - 1;
    return {at, 1 - glm::smoothstep(0.0f, 0.6f, outside), 0};
}

}  // namespace

shared::Frame frameUniforms(const FrameInput& input, const RenderOptions& options, const FrameSetup& setup) {
    shared::Frame frame{};
    frame.viewProjection = setup.view.viewProjection;
    frame.rayAhead = glm::vec4(setup.view.ahead, 0);
    frame.rayAcross = glm::vec4(setup.view.across, 0);
    frame.rayUp = glm::vec4(setup.view.up, 0);
    frame.cameraPosition = glm::vec4(setup.view.cameraPosition, input.fogDistance);
    setEnvironment(frame, input);
    const float growth = options.tJunctions == TJunctions::Covered ? setup.crackGrowth : 0.0f;
    frame.viewport = glm::vec4(setup.size, growth, kNearPlane);
    frame.shadow.z = kShadowReach;
    if (setup.shadowSize > 0) {
        const ShadowFit fit = fitShadowMap(input.camera, setup.size.x / setup.size.y,
                                           input.environment.lightDirection, setup.shadowSize);
        frame.toShadowMap = fit.toMap;
        frame.shadow = {1, fit.texelBlocks, kShadowReach, static_cast<float>(setup.shadowSize)};
    }
    frame.light = lightOnScreen(setup.view, input.environment.lightDirection);
    frame.light.w = input.isUnderWater ? 1.0f : 0.0f;
    const world::ChunkPos chunk = cameraChunk(input.camera);
    frame.camera = {chunk.x, chunk.y, switchesOf(options), options.singleLayer};
    return frame;
}

}  // namespace terrane::render
