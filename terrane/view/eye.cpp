#include "terrane/view/eye.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "terrane/world/ray_cast.h"

namespace terrane::view {
namespace {

constexpr int kColumns = 10, kRows = 7;  // rays
constexpr double kReach = 64;            // blocks
constexpr double kLookSeconds = 0.1;
constexpr double kSecondsToBrighter = 0.4, kSecondsToDarker = 1.5;

constexpr float kDaylight = 0.25f;   // from here on nothing changes: the light of a wood by day
constexpr float kAdaptation = 0.6f;  // share of the stops of darkness that are made up for
constexpr float kMostExposure = 6;
constexpr float kWhiteBalance = 0.5f;  // share of a color, in stops, that is made up for
constexpr float kMostBalance = 1.5f;   // of a channel
constexpr float kMeanAlbedo = 0.3f;

// As kMinLight, brightnessOf() and shade() in lighting.glsl.
constexpr float kMinLight = 0.006f, kAmbientFromBelow = 0.4f;

float luminance(glm::vec3 color) {
    return glm::dot(color, {0.2126f, 0.7152f, 0.0722f});
}

float brightness(light::LightValue value, int component) {
    const float level = static_cast<float>(light::levelOf(value, component)) / light::kMaxLevel;
    return glm::mix(level, std::sqrt(level), 0.23f);
}

// On a surface. Nothing is known of shadows: half of the direct light counts.
glm::vec3 lightOn(glm::vec3 normal, light::LightValue levels, const world::Environment& environment) {
    const float daylight = brightness(levels, 3);
    const glm::vec3 lamps = {brightness(levels, 0), brightness(levels, 1), brightness(levels, 2)};
    const float facing = 0.5f * std::max(glm::dot(normal, environment.lightDirection), 0.0f);
    const glm::vec3 around =
        environment.ambientColor * glm::mix(kAmbientFromBelow, 1.0f, 0.5f + 0.5f * normal.z);
    return kMinLight + lamps * (1 - environment.lampShare * daylight) +
           daylight * luminance(around + environment.lightColor * facing);
}

// The sky is as bright as a surface of the mean albedo in this light.
float lightOfSky(const world::Environment& environment) {
    return std::max(kMinLight,
                    luminance(0.5f * (environment.horizonColor + environment.zenithColor)) / kMeanAlbedo);
}

glm::vec3 lightAlong(const game::Session& session, const world::Ray& ray,
                     const world::Environment& environment) {
    const auto hit = world::castRay(session.world(), session.blocks(), ray, kReach);
    glm::vec3 normal(0, 0, 1);
    world::BlockPos before = world::blockOf(ray.origin + kReach * ray.direction);
    glm::vec3 glow(0);
    if (hit) {
        const auto& emission = session.blocks().type(session.world().block(hit->block)).emission;
        glow = glm::vec3(emission[0], emission[1], emission[2]) / (light::kMaxLevel * kMeanAlbedo);
        before = world::adjacent(hit->block, hit->face);
        normal = {before.x - hit->block.x, before.y - hit->block.y, before.z - hit->block.z};
    }
    const light::LightValue levels = session.pipeline().lightAt(before).value_or(light::kFullDaylight);
    const bool isSky = !hit && ray.direction.z > 0 && light::levelOf(levels, 3) == light::kMaxLevel;
    return isSky ? glm::vec3(lightOfSky(environment)) : glow + lightOn(normal, levels, environment);
}

}  // namespace

std::optional<std::string> blockAtCamera(const game::Session& session, const render::Camera& camera) {
    if (const world::BlockType* type = game::solidBlockAt(session, camera.position))
        return "inside " + type->name;
    // A corner of the near plane is farther away than its middle.
    constexpr double kTouches = 2 * render::kNearPlane;
    if (const world::BlockType* type = game::solidBlockAt(session, camera.position, kTouches))
        return "at a face of " + type->name;
    return std::nullopt;
}

SeenLight seenLight(const game::Session& session, const render::FrameInput& input, float aspect) {
    const render::ViewMatrices view = render::viewMatrices(input.camera, aspect);
    float stops = 0;
    glm::vec3 colors(0);
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kColumns; ++column) {
            const float u = (2 * static_cast<float>(column) + 1) / kColumns - 1;
            const float v = (2 * static_cast<float>(row) + 1) / kRows - 1;
            const glm::vec3 direction = glm::normalize(view.ahead + u * view.across + v * view.up);
            const glm::vec3 light =
                lightAlong(session, {input.camera.position, direction}, input.environment);
            stops += std::log2(luminance(light));
            colors += light / luminance(light);
        }
    }
    constexpr float kRays = kColumns * kRows;
    return {std::exp2(stops / kRays), colors / kRays};
}

glm::vec3 exposureFor(const SeenLight& light) {
    const float exposure =
        std::clamp(std::pow(kDaylight / light.luminance, kAdaptation), 1.0f, kMostExposure);
    const glm::vec3 balance =
        glm::min(glm::pow(light.color, glm::vec3(-kWhiteBalance)), glm::vec3(kMostBalance));
    return exposure * balance / luminance(balance * light.color);
}

glm::vec3 Eye::look(const game::Session& session, const render::FrameInput& input, float aspect,
                    double seconds) {
    const bool isFirst = exposure_ == glm::vec3(0);
    sinceLook_ += seconds;
    if (isFirst || sinceLook_ >= kLookSeconds) {
        target_ = exposureFor(seenLight(session, input, aspect));
        sinceLook_ = 0;
    }
    if (isFirst) exposure_ = target_;
    const double slowness = luminance(target_) < luminance(exposure_) ? kSecondsToBrighter : kSecondsToDarker;
    exposure_ += (target_ - exposure_) * static_cast<float>(1 - std::exp(-seconds / slowness));
    return exposure_;
}

}  // namespace terrane::view
