#include "terrane/render/frame/frame_uniforms.h"

#include <cmath>

#include "terrane/render/frame/tone.h"

namespace terrane::render {
namespace {

constexpr float kAmbientFromBelow = 0.4f;  // share of the sky's light on faces that look down

static_assert(static_cast<shared::uint>(View::Normal) == shared::kViewNormal &&
              static_cast<shared::uint>(View::Depth) == shared::kViewDepth &&
              static_cast<shared::uint>(View::Merging) == shared::kViewMerging &&
              static_cast<shared::uint>(View::Light) == shared::kViewLight);

int switchesOf(const RenderOptions& o) {
    return (o.animation ? shared::kSwitchAnimation : 0) | (o.distanceFog ? shared::kSwitchDistanceFog : 0) |
           (o.shading == Shading::Off ? shared::kSwitchUnlit : 0);
}

void setEnvironment(shared::Frame& frame, const world::Environment& e) {
    frame.lightDirection = glm::vec4(e.lightDirection, 0);
    frame.lightColor = glm::vec4(e.lightColor, 0);
    frame.ambientColor = glm::vec4(e.ambientColor, 0);
    frame.horizonColor = glm::vec4(e.horizonColor, 0);
    frame.glowColor = glm::vec4(e.glowColor, 0);
    frame.discColor = glm::vec4(e.discColor, 0);
    frame.discSine = std::sin(e.discRadius);
    frame.hiddenLampShare = e.lampShare;
    frame.starBrightness = e.starLight;
    frame.starTurn = e.starTurn;
    frame.isMoon = e.isMoon ? 1 : 0;
}

void setView(shared::Frame& frame, const ViewMatrices& view) {
    frame.viewProjection = view.viewProjection;
    frame.rayAhead = glm::vec4(view.ahead, 0);
    frame.rayAcross = glm::vec4(view.across, 0);
    frame.rayUp = glm::vec4(view.up, 0);
    frame.cameraPosition = glm::vec4(view.cameraPosition, 0);
    frame.nearPlane = kNearPlane;
}

// Rays of a light behind the camera or far outside the image are not visible.
void setLightOnScreen(shared::Frame& frame, const ViewMatrices& view, glm::vec3 direction) {
    const glm::vec4 p = view.viewProjection * glm::vec4(direction, 0);
    if (p.w <= 0.01f) return;
    frame.lightOnScreen = glm::vec2(p) / p.w;
    const float outside = std::max(std::abs(frame.lightOnScreen.x), std::abs(frame.lightOnScreen.y)) - 1;
    frame.lightRayShare = 1 - glm::smoothstep(0.0f, 0.6f, outside);
}

}  // namespace

shared::Frame frameUniforms(const FrameInput& input, const RenderOptions& options, const FrameSetup& setup) {
    shared::Frame frame{};
    setView(frame, setup.view);
    setEnvironment(frame, input.environment);
    setLightOnScreen(frame, setup.view, input.environment.lightDirection);
    frame.viewportSize = setup.size;
    frame.edgeExpansion = options.tJunctions == TJunctions::Covered ? setup.edgeExpansion : 0.0f;
    frame.fogDistance = input.fogDistance;
    frame.timeSeconds = input.timeSeconds;
    frame.exposure = glm::vec4(kExposure * (options.adaptation ? input.exposure : glm::vec3(1)), 0);
    frame.ambientFromBelow = kAmbientFromBelow;
    frame.waterAbove = static_cast<shared::uint>(input.waterAbove);
    frame.view = static_cast<shared::uint>(input.view);
    const world::ChunkPos chunk = cameraChunk(input.camera);
    frame.cameraChunk = {chunk.x, chunk.y};
    frame.switches = switchesOf(options);
    frame.singleTransparencyLayer = options.singleTransparencyLayer;
    return frame;
}

}  // namespace terrane::render
