// Sky and air for shaders: a small texture of the sky, computed again when the sun or moon has moved by a
// just visible step, the Milky Way, and the uniforms of a frame. The renderer uses it on the context's
// thread.
#pragma once

#include <cmath>

#include "terrane/gpu/mapped_ring.h"
#include "terrane/gpu/texture.h"
#include "terrane/shared/air.h"
#include "terrane/shared/hash.h"
#include "terrane/world/sky/environment.h"

namespace terrane::render {

// Returns value noise, 0…1: random numbers on a lattice of `cells` × `cells` (a power of two) in the unit
// square, smoothly interpolated. The noise repeats.
inline float valueNoise(float x, float y, int cells, std::uint32_t seed) {
    const auto at = [&](int cx, int cy) {
        const auto wrap = [&](int c) { return static_cast<std::uint32_t>(c & (cells - 1)); };
        return static_cast<float>(shared::hash2(wrap(cx), wrap(cy), seed) >> 8) / 16777216.0f;
    };
    const auto smooth = [](float t) { return t * t * (3 - 2 * t); };
    const float fx = x * static_cast<float>(cells), fy = y * static_cast<float>(cells);
    const int ix = static_cast<int>(std::floor(fx)), iy = static_cast<int>(std::floor(fy));
    const float u = smooth(fx - static_cast<float>(ix)), v = smooth(fy - static_cast<float>(iy));
    return std::lerp(std::lerp(at(ix, iy), at(ix + 1, iy), u),
                     std::lerp(at(ix, iy + 1), at(ix + 1, iy + 1), u), v);
}

// Returns the sum of `count` octaves of value noise, each with half the weight and twice the frequency; 0…1.
inline float octaves(float x, float y, int firstCells, int count, std::uint32_t seed) {
    float sum = 0, weight = 0.5f;
    for (int k = 0; k < count; ++k, weight *= 0.5f) {
        sum += weight * valueNoise(x, y, firstCells << k, seed + static_cast<std::uint32_t>(k));
    }
    return sum / (1 - 2 * weight);  // weights from 0.5 on sum up to 1 less twice the next one
}

// Tiling noise for the shaders of clouds and waves. The renderer uses it on the context's thread.
class SkyNoise {
  public:
    SkyNoise() = default;
    // Creates 256 × 256 texels of four channels with all mipmaps, 350 KB, on the CPU in 5 ms. Red: five
    // octaves; green: others; blue and alpha: slope of smooth bumps along x and y, 0.5 is level.
    static SkyNoise create();

    void addTo(gpu::TextureSet& textures) const;
    std::size_t gpuBytes() const { return texture_.sizeBytes(); }

  private:
    gpu::Texture2D texture_;
    gpu::Sampler sampler_;
};

// The band of the Milky Way as a texture, generated from noise at the start. The renderer uses it on the
// context's thread.
class MilkyWay {
  public:
    MilkyWay() = default;
    // Creates 256 × 64 texels of four channels, 64 KiB, in about 5 ms. Columns: longitude along the band,
    // around the sky; rows: latitude, sine -0.6 … 0.6. sRGB.
    static MilkyWay create();

    void addTo(gpu::TextureSet& textures) const;
    std::size_t gpuBytes() const { return texture_.sizeBytes(); }

  private:
    gpu::Texture2D texture_;
    gpu::Sampler sampler_;
};

// Returns the uniforms of the air around a camera at a height.
shared::AirFrame airUniforms(const world::Environment& environment, const world::AirLevels& levels,
                             float cameraZ);

class SkyTexture {
  public:
    SkyTexture() = default;
    static SkyTexture create();  // 64 × 32 × 8 bytes = 16 KiB, and the Milky Way

    // Writes the uniforms of a frame. Takes some 2 ms if the sine of the light's elevation has moved by a
    // step of 1/2,500: every half second of a day of 20 minutes.
    void update(const world::Environment& environment, const world::AirLevels& levels, float cameraZ,
                gpu::MappedRing& ring);
    void addTo(gpu::TextureSet& textures) const;
    std::size_t gpuBytes() const { return texture_.sizeBytes() + milkyWay_.gpuBytes(); }

  private:
    gpu::Texture2D texture_;
    gpu::Sampler sampler_;
    MilkyWay milkyWay_;
    int step_ = 1 << 20;  // of the light's sine, that the texture was made for
    bool isMoon_ = false;
};

}  // namespace terrane::render
