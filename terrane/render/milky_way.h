// The band of the Milky Way as a texture, generated from noise at the start. Used by the renderer on the
// context's thread.
#pragma once

#include "terrane/gpu/sampler.h"
#include "terrane/gpu/texture.h"

namespace terrane::render {

class MilkyWay {
  public:
    MilkyWay() = default;
    // 256 × 64 texels of four channels, 64 KiB, in some 5 ms. Columns: longitude along the band, around the
    // sky; rows: latitude, sine -0.6 … 0.6. sRGB.
    static MilkyWay create();

    void bind() const;
    std::size_t gpuBytes() const { return texture_.sizeBytes(); }

  private:
    gpu::Texture2D texture_;
    gpu::Sampler sampler_;
};

}  // namespace terrane::render
