// Tiling noise for the shaders of clouds and waves. Used by the renderer on the context's thread.
#pragma once

#include "terrane/gpu/sampler.h"
#include "terrane/gpu/texture.h"

namespace terrane::render {

class SkyNoise {
  public:
    SkyNoise() = default;
    // 256 × 256 texels of four channels with all mipmaps, 350 KB, made by the CPU in 5 ms. Red: five
    // octaves; green: others; blue and alpha: slope of smooth bumps along x and y, 0.5 is level.
    static SkyNoise create();

    void bind() const;
    std::size_t gpuBytes() const { return texture_.sizeBytes(); }

  private:
    gpu::Texture2D texture_;
    gpu::Sampler sampler_;
};

}  // namespace terrane::render
