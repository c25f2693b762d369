// Light of a block: four levels of 0…15. Any thread.
#pragma once

#include <array>
#include <cstdint>

#include "terrane/world/coords.h"

namespace terrane::light {

// Red in bits 0–3, green 4–7, blue 8–11, daylight 12–15.
using LightValue = std::uint16_t;

enum LightComponent : int { kRed, kGreen, kBlue, kDaylight, kComponentCount };

constexpr int kMaxLevel = 15;
constexpr LightValue kDark = 0;
constexpr LightValue kFullDaylight = kMaxLevel << 12;

constexpr int levelOf(LightValue value, int component) {
    return value >> (4 * component) & kMaxLevel;
}

constexpr LightValue withLevel(LightValue value, int component, int level) {
    return static_cast<LightValue>((value & ~(kMaxLevel << 4 * component)) | level << 4 * component);
}

// The same level in all four components, the form of opacities.
constexpr LightValue allComponents(int level) {
    return static_cast<LightValue>(level * 0x1111);
}

}  // namespace terrane::light
