// Conversion between sRGB and linear light (IEC 61966-2-1), 0…1. Any thread.
#pragma once

#include <cmath>

namespace terrane::base {

inline float decodeSrgb(float v) {
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}
inline float encodeSrgb(float v) {
    return v <= 0.0031308f ? v * 12.92f : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f;
}

}  // namespace terrane::base
