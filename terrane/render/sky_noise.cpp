#include "terrane/render/sky_noise.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "terrane/render/tiling_noise.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {
namespace {

constexpr int kSize = 256;

float bumps(float x, float y) {
    return octaves(x, y, 8, 3, 40);
}

std::uint8_t byteOf(float v) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(255 * v), 0L, 255L));
}

}  // namespace

SkyNoise SkyNoise::create() {
    std::vector<std::uint8_t> texels;
    texels.reserve(4 * kSize * kSize);
    constexpr float kStep = 1.0f / kSize, kSlope = 6;
    for (int row = 0; row < kSize; ++row) {
        for (int column = 0; column < kSize; ++column) {
            const float x = static_cast<float>(column) * kStep, y = static_cast<float>(row) * kStep;
            texels.push_back(byteOf(octaves(x, y, 4, 5, 1)));
            texels.push_back(byteOf(octaves(x, y, 16, 4, 20)));
            texels.push_back(byteOf(0.5f + kSlope * (bumps(x + kStep, y) - bumps(x, y))));
            texels.push_back(byteOf(0.5f + kSlope * (bumps(x, y + kStep) - bumps(x, y))));
        }
    }
    SkyNoise noise;
    noise.texture_ = gpu::Texture2D({kSize, kSize}, GL_RGBA8, gpu::fullLevels({kSize, kSize}), "noise");
    noise.texture_.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(texels)));
    noise.texture_.generateMipmaps();
    noise.sampler_ =
        gpu::Sampler({.minFilter = GL_LINEAR_MIPMAP_LINEAR, .wrapS = GL_REPEAT, .wrapT = GL_REPEAT}, "noise");
    return noise;
}

void SkyNoise::bind() const {
    texture_.bind(shared::kSkyNoiseUnit);
    sampler_.bind(shared::kSkyNoiseUnit);
}

}  // namespace terrane::render
