#include "terrane/render/sky_noise.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "terrane/shared/bindings.h"
#include "terrane/shared/hash.h"

namespace terrane::render {
namespace {

constexpr int kSize = 256;

float smooth(float t) {
    return t * t * (3 - 2 * t);
}

// Random numbers on a lattice of `cells` a side that tiles, smoothly joined; 0…1.
float valueNoise(float x, float y, int cells, std::uint32_t seed) {
    const auto at = [&](int cx, int cy) {
        const auto wrap = [&](int c) { return static_cast<std::uint32_t>(c & (cells - 1)); };
        return static_cast<float>(shared::hash2(wrap(cx), wrap(cy), seed) >> 8) / 16777216.0f;
    };
    const float fx = x * static_cast<float>(cells), fy = y * static_cast<float>(cells);
    const int ix = static_cast<int>(std::floor(fx)), iy = static_cast<int>(std::floor(fy));
    const float u = smooth(fx - static_cast<float>(ix)), v = smooth(fy - static_cast<float>(iy));
    return std::lerp(std::lerp(at(ix, iy), at(ix + 1, iy), u),
                     std::lerp(at(ix, iy + 1), at(ix + 1, iy + 1), u), v);
}

float octaves(float x, float y, int firstCells, int count, std::uint32_t seed) {
    float sum = 0, weight = 0.5f;
    for (int k = 0; k < count; ++k, weight *= 0.5f) {
        sum += weight * valueNoise(x, y, firstCells << k, seed + static_cast<std::uint32_t>(k));
    }
    return sum / (1 - 2 * weight);  // weights from 0.5 on sum up to 1 less twice the next one
}

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
