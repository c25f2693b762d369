#include "terrane/world/tint.h"

#include <algorithm>
#include <cmath>

namespace terrane::world {
namespace {

// 1/255 at least, since its logarithm is taken.
float channelOf(PackedColor color, int shift) {
    return static_cast<float>(std::max(color >> shift & 255u, 1u)) / 255.0f;
}

}  // namespace

glm::vec3 tinted(glm::vec3 color, PackedColor tint) {
    for (int c = 0; c < 3; ++c) {
        const int shift = 16 - 8 * c;
        const float exponent = std::log(channelOf(tint, shift)) / std::log(channelOf(kNeutralTint, shift));
        color[c] = std::pow(std::max(color[c], 1e-10f), exponent);
    }
    return color;
}

}  // namespace terrane::world
