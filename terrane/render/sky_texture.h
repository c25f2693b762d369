// The sky and the air as shaders see them: a small texture of the sky, computed anew whenever sun or moon
// have moved by a step that can just be seen, the Milky Way, and the uniforms of a frame. Used by the
// renderer on the context's thread.
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

    // For a frame. Takes some 2 ms where the light has moved by 1/2,500, a step of its sine: every half
    // second of a day of 20 minutes.
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
