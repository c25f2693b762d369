// The tint around the camera as textures: a clipmap's levels (clipmap.h), one layer each. Takes no
// memory where there is no tint. Used by the renderer on the context's thread.
#pragma once

#include <optional>

#include "terrane/gpu/mapped_ring.h"
#include "terrane/gpu/sampler.h"
#include "terrane/gpu/texture.h"
#include "terrane/render/clipmap.h"
#include "terrane/world/tint.h"

namespace terrane::render {

class TintTextures {
  public:
    TintTextures() = default;      // none
    static TintTextures create();  // 1.3 MB
    bool isUsed() const { return textures_.id() != 0; }
    const Clipmap& clipmap() const { return clipmap_; }

    void set(world::ChunkPos tile, const world::TintTile& colors);
    // For a frame from the camera; nothing where there is no tint.
    void bind(const Camera& camera, gpu::MappedRing& ring) const;
    std::size_t gpuBytes() const { return textures_.sizeBytes(); }

  private:
    Clipmap clipmap_{kTintClipmap};
    gpu::Texture2DArray textures_;
    gpu::Sampler sampler_;
};

}  // namespace terrane::render
