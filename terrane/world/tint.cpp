#include "terrane/world/tint.h"

#include <algorithm>

namespace terrane::world {
namespace {

// 1/255 at least: a black tint divides by zero for white.
float channelOf(PackedColor color, int shift) {
    return static_cast<float>(std::max(color >> shift & 255u, 1u)) / 255.0f;
}

}  // namespace

glm::vec3 tinted(glm::vec3 color, PackedColor tint) {
    for (int c = 0; c < 3; ++c) {
        const int shift = 16 - 8 * c;
        const float t = channelOf(tint, shift), neutral = channelOf(kNeutralTint, shift);
        color[c] = color[c] * t / (t + (1.0f - color[c]) * (neutral - t) / (1.0f - neutral));
    }
    return color;
}

}  // namespace terrane::world
