#include "terrane/world/environment.h"

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>

namespace terrane::world {
namespace {

// The moon waits at the horizon from kMoonSets on while its light fades; at kSunRises, in the dark, the sun
// takes its place. From kSunSets to kMoonRises the other way round.
constexpr float kMoonSets = 0.12f, kSunRises = 0.15f, kSunSets = 0.85f, kMoonRises = 0.88f;

struct ColorKey {
    float time;
    glm::vec3 color;
};

// Colors as seen on a screen (sRGB, 0…255), by time of day; linear in between, around midnight too.
constexpr std::array kLight = {
    ColorKey{.12f, {72, 90, 126}},   ColorKey{.15f, {0, 0, 0}},       ColorKey{.2f, {255, 160, 90}},
    ColorKey{.27f, {255, 236, 200}}, ColorKey{.73f, {255, 240, 208}}, ColorKey{.8f, {255, 140, 80}},
    ColorKey{.85f, {0, 0, 0}},       ColorKey{.88f, {72, 90, 126}},
};
constexpr std::array kAmbient = {
    ColorKey{.13f, {46, 54, 80}},    ColorKey{.2f, {120, 116, 132}}, ColorKey{.27f, {190, 200, 214}},
    ColorKey{.73f, {190, 200, 214}}, ColorKey{.8f, {128, 112, 130}}, ColorKey{.87f, {46, 54, 80}},
};
constexpr std::array kZenith = {
    ColorKey{.13f, {8, 12, 28}},    ColorKey{.2f, {58, 84, 132}}, ColorKey{.27f, {44, 112, 214}},
    ColorKey{.73f, {44, 112, 214}}, ColorKey{.8f, {56, 66, 120}}, ColorKey{.87f, {8, 12, 28}},
};
constexpr std::array kHorizon = {
    ColorKey{.13f, {24, 32, 54}},    ColorKey{.2f, {214, 168, 140}}, ColorKey{.27f, {182, 212, 236}},
    ColorKey{.73f, {182, 212, 236}}, ColorKey{.8f, {214, 142, 122}}, ColorKey{.87f, {24, 32, 54}},
};
constexpr std::array kGlow = {
    ColorKey{.13f, {10, 14, 26}},   ColorKey{.2f, {255, 150, 70}}, ColorKey{.27f, {120, 104, 76}},
    ColorKey{.73f, {120, 104, 76}}, ColorKey{.8f, {255, 120, 56}}, ColorKey{.87f, {10, 14, 26}},
};

float fraction(float v) {
    return v - std::floor(v);
}

glm::vec3 linearFromSrgb(glm::vec3 color) {
    const auto channel = [](float v) {
        v /= 255.0f;
        return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
    };
    return {channel(color.x), channel(color.y), channel(color.z)};
}

glm::vec3 colorAt(std::span<const ColorKey> keys, float time) {
    std::size_t next = 0;
    while (next < keys.size() && keys[next].time <= time) ++next;
    const ColorKey& from = keys[(next + keys.size() - 1) % keys.size()];
    const ColorKey& to = keys[next % keys.size()];
    const float span = fraction(to.time - from.time), passed = fraction(time - from.time);
    return linearFromSrgb(glm::mix(from.color, to.color, passed / span));
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

}  // namespace

Environment environmentAt(float timeDay) {
    const float time = fraction(timeDay);
    const bool isSun = time >= kSunRises && time < kSunSets;
    Environment e{};
    e.lightDirection = lightDirection(time);
    e.lightColor = colorAt(kLight, time) * (isSun ? 0.9f : 1.0f);
    e.ambientColor = colorAt(kAmbient, time);
    e.zenithColor = colorAt(kZenith, time);
    e.horizonColor = colorAt(kHorizon, time);
    e.glowColor = colorAt(kGlow, time);
    e.isMoon = !isSun;
    e.starTurn = time;
    e.discColor = (isSun ? 8.0f : 9.0f) * e.lightColor;
    e.starLight = glm::smoothstep(0.0f, 1.0f, glm::clamp((std::abs(time - 0.5f) - 0.29f) / 0.1f, 0.0f, 1.0f));
    e.discRadius = isSun ? 0.045f : 0.03f;
    const glm::vec3 noon = linearFromSrgb(kAmbient[2].color);
    e.lampShare = 0.8f * glm::clamp(e.ambientColor.y / noon.y, 0.0f, 1.0f);
    return e;
}

}  // namespace terrane::world
