#include "terrane/world/environment.h"

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace terrane::world {
namespace {

// From kMoonSets the moon stays under the horizon; at kSunRises, in the dark, the sun takes its place. The
// reverse from kSunSets to kMoonRises.
constexpr float kMoonSets = 0.12f, kSunRises = 0.15f, kSunSets = 0.85f, kMoonRises = 0.88f;

// To the eye a light a hundredth as strong is a sixteenth as bright: brightness grows with the power 0.6 of
// luminance (near the exponents of S. S. Stevens, On the Psychophysical Law, 1957). So twilight and the
// zenith are not black.
constexpr float kEyePower = 0.6f;
// Factors from the curve to colors, chosen for the brightness of noon.
constexpr float kSunScale = 0.90f, kAmbientScale = 2.75f, kSkyScale = 2.3f;
// Colors of the sky are this much farther from grey than three samples of the spectrum give.
constexpr float kVividness = 1.35f;

// Moonlight in proportion to sunlight, as the eye sees it: far brighter than in nature, so that players can
// see. The sky is darker than that, for the stars.
struct LightScales {
    glm::vec3 direct, ambient, sky;
};
constexpr LightScales kSun{glm::vec3(kSunScale), glm::vec3(kAmbientScale), glm::vec3(kSkyScale)};
constexpr glm::vec3 kMoonColor{0.62f, 0.92f, 1.6f};
constexpr LightScales kMoon{kSunScale * 0.125f * kMoonColor, kAmbientScale * 0.03f * kMoonColor,
                            kSkyScale * 0.028f * kMoonColor};

// Light without sun and moon: airglow and stars.
constexpr glm::vec3 kNightAmbient{0.018f, 0.024f, 0.046f};
constexpr glm::vec3 kNightZenith{0.0016f, 0.0024f, 0.0070f}, kNightHorizon{0.0048f, 0.0070f, 0.0165f};

float fraction(float v) {
    return v - std::floor(v);
}

float luminance(glm::vec3 v) {
    return glm::dot(v, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

glm::vec3 asSeen(glm::vec3 light) {
    const float bright = luminance(light);
    return bright > 1e-12f ? light * std::pow(bright, kEyePower - 1) : glm::vec3(0);
}

const LightScales& scalesOf(bool isMoon) {
    return isMoon ? kMoon : kSun;
}

// A quarter as colorful as the sky: clouds and ground reflect light of all colors.
glm::vec3 ambientOf(float sine, bool isMoon) {
    const glm::vec3 sky = asSeen(skyIrradiance(sine));
    return scalesOf(isMoon).ambient * glm::mix(glm::vec3(luminance(sky)), sky, 0.25f) + kNightAmbient;
}

glm::vec3 colorOf(glm::vec3 radiance, float sine, bool isMoon) {
    const float nearHorizon = std::exp(-5.5f * sine);
    const glm::vec3 seen = asSeen(radiance);
    const glm::vec3 vivid = glm::max(glm::mix(glm::vec3(luminance(seen)), seen, kVividness), 0.05f * seen);
    return scalesOf(isMoon).sky * vivid + glm::mix(kNightZenith, kNightHorizon, nearHorizon);
}

// Sun and moon share one path from east (-x) to west, tilted to the south (-y … +y); the moon runs it
// backwards and faster, through the night.
glm::vec3 lightDirection(float time) {
    const bool isSun = time >= kSunRises && time < kSunSets;
    const bool isMoon = time < kMoonSets || time >= kMoonRises;
    float path = time < 0.5f ? 0.0f : 1.0f;
    if (isSun) path = (time - kSunRises) / (kSunSets - kSunRises);
    if (isMoon) path = 1.0f - fraction(time - kMoonRises) / fraction(kMoonSets - kMoonRises);
    const float angle = 3.14159265f * path;
    return glm::normalize(
        glm::vec3(-std::cos(angle), 0.5f * std::sin(angle), 1.25f * std::sin(angle) - 0.25f));
}

void setSkyColors(Environment& e) {
    const glm::vec3 ahead = glm::normalize(glm::vec3(e.lightDirection.x, e.lightDirection.y, 0));
    const glm::vec3 aside(-ahead.y, ahead.x, 0);
    const auto at = [&](glm::vec3 level) {
        return skyColor(glm::normalize(level + glm::vec3(0, 0, 0.08f)), e.lightDirection, e.isMoon);
    };
    const glm::vec3 under = at(ahead), beside = at(aside), opposite = at(-ahead);
    e.zenithColor = skyColor({0, 0, 1}, e.lightDirection, e.isMoon);
    e.horizonColor = 0.25f * (under + 2.0f * beside + opposite);
    e.glowColor = glm::max(under - beside, glm::vec3(0));
}

}  // namespace

glm::vec3 skyColor(glm::vec3 direction, glm::vec3 toLight, bool isMoon) {
    return colorOf(skyRadiance(direction, toLight), direction.z, isMoon);
}

SkyTable skyColorTable(float sine, bool isMoon) {
    SkyTable table = skyTable(sine);
    for (std::size_t k = 0; k < table.radiance.size(); ++k) {
        const float root = static_cast<float>(k / SkyTable::kColumns) / (SkyTable::kRows - 1);
        table.radiance[k] = colorOf(table.radiance[k], root * root, isMoon);
    }
    return table;
}

float ambientGreen(float sine, bool isMoon) {
    return ambientOf(sine, isMoon).y;
}

Environment environmentAt(float timeDay) {
    const float time = fraction(timeDay);
    const bool isSun = time >= kSunRises && time < kSunSets;
    Environment e{};
    e.lightDirection = lightDirection(time);
    e.isMoon = !isSun;
    const float sine = e.lightDirection.z;
    e.lightColor = scalesOf(e.isMoon).direct * asSeen(directLight(sine));
    e.ambientColor = ambientOf(sine, e.isMoon);
    setSkyColors(e);
    e.starTurn = time;
    // Unlike its light on the ground the disc keeps its color down to the horizon, which hides it.
    const glm::vec3 disc = asSeen(directLight(std::max(sine, kDiscFade)));
    e.discColor = (isSun ? 8.0f : 9.0f) * scalesOf(e.isMoon).direct * disc;
    e.starLight = glm::smoothstep(0.0f, 1.0f, glm::clamp((std::abs(time - 0.5f) - 0.29f) / 0.1f, 0.0f, 1.0f));
    e.discRadius = isSun ? 0.045f : 0.03f;
    e.lampShare = 0.8f * glm::clamp(e.ambientColor.y / 0.56f, 0.0f, 1.0f);
    return e;
}

}  // namespace terrane::world
