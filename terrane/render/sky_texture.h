// Sky and air for shaders: a small texture of the sky, computed again when the sun or moon has moved by a
// just visible step, the Milky Way, and the uniforms of a frame. Used by the renderer on the context's
// thread.
#pragma once

#include "terrane/gpu/mapped_ring.h"
#include "terrane/gpu/sampler.h"
#include "terrane/gpu/texture.h"
#include "terrane/render/milky_way.h"
#include "terrane/shared/air.h"
#include "terrane/world/environment.h"

namespace terrane::render {

// `altitudeZ`: of the camera, blocks.
shared::AirFrame airUniforms(const world::Environment& environment, float altitudeZ);

class SkyTexture {
  public:
    SkyTexture() = default;
    static SkyTexture create();  // 64 × 32 × 8 bytes = 16 KiB, and the Milky Way

    // Binds everything for a frame. Takes some 2 ms if the sine of the light's elevation has moved by a step
    // of 1/2,500: every half second of a day of 20 minutes.
    void bind(const world::Environment& environment, float altitudeZ, gpu::MappedRing& ring);
    std::size_t gpuBytes() const { return texture_.sizeBytes() + milkyWay_.gpuBytes(); }

  private:
    gpu::Texture2D texture_;
    gpu::Sampler sampler_;
    MilkyWay milkyWay_;
    int step_ = 1 << 20;  // of the light's sine, that the texture was made for
    bool isMoon_ = false;
};

}  // namespace terrane::render
