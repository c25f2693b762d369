#include "terrane/render/milky_way.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "terrane/render/tiling_noise.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {
namespace {

constexpr int kColumns = 256, kRows = 64;

float gauss(float v) {
    return std::exp(-v * v);
}

// `along`: 0…1 around the sky, 0.5 the brightest part; `across`: -1…1. Clouds of stars fade outward, wider
// and warmer in the middle; dark lanes of dust run along the band, in front of the brightest part.
glm::vec3 bandColor(float along, float across) {
    const float y = 0.5f + 0.25f * across;  // stretched along: a cell is twice as long as wide
    const float bend = 0.16f * (octaves(along, 0.3f, 4, 3, 70) - 0.5f);
    const float bulge = gauss((along - 0.5f) / 0.11f), from = across - bend;
    const float width = 0.26f + 0.2f * bulge;
    const float clumps = octaves(along, y, 16, 5, 80);
    const float stars = gauss(from / width) * (0.35f + 0.65f * bulge) * (0.35f + 1.3f * clumps);
    const float winding = 0.3f * (octaves(along, y, 8, 4, 90) - 0.5f);
    const float torn = glm::smoothstep(0.35f, 0.65f, octaves(along, y, 16, 4, 100));
    const float dust = gauss((from - winding) / (0.09f + 0.05f * bulge)) * (0.25f + 0.75f * torn);
    const glm::vec3 warm(1.0f, 0.88f, 0.78f), cold(0.6f, 0.76f, 1.0f);
    const glm::vec3 color = glm::mix(cold, warm, bulge);
    // Dust absorbs blue first.
    return color * stars * glm::mix(glm::vec3(1), glm::vec3(0.32f, 0.24f, 0.2f), dust) *
           glm::smoothstep(1.0f, 0.7f, std::abs(across));
}

std::uint8_t displayedByte(float v) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(255 * std::pow(v, 1 / 2.2f)), 0L, 255L));
}

}  // namespace

MilkyWay MilkyWay::create() {
    std::vector<std::uint8_t> texels;
    texels.reserve(4 * kColumns * kRows);
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kColumns; ++column) {
            const glm::vec3 color = bandColor((static_cast<float>(column) + 0.5f) / kColumns,
                                              (2 * static_cast<float>(row) + 1) / kRows - 1);
            for (const float channel : {color.x, color.y, color.z}) texels.push_back(displayedByte(channel));
            texels.push_back(255);
        }
    }
    MilkyWay made;
    made.texture_ = gpu::Texture2D({kColumns, kRows}, GL_SRGB8_ALPHA8, 1, "milky way");
    made.texture_.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(texels)));
    made.sampler_ = gpu::Sampler({.wrapS = GL_REPEAT}, "milky way");
    return made;
}

void MilkyWay::bind() const {
    texture_.bind(shared::kMilkyWayUnit);
    sampler_.bind(shared::kMilkyWayUnit);
}

}  // namespace terrane::render
