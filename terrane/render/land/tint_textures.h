// The tint around the camera as textures: one layer for each level of a clipmap (clipmap.h). Takes no memory
// without a tint. The renderer uses it on the context's thread.
#pragma once

#include <optional>

#include "terrane/gpu/mapped_ring.h"
#include "terrane/gpu/texture.h"
#include "terrane/render/land/clipmap.h"
#include "terrane/world/tint.h"

namespace terrane::render {

class TintTextures {
  public:
    TintTextures() = default;      // none
    static TintTextures create();  // 1.3 MB
    bool isUsed() const { return textures_.id() != 0; }
    const Clipmap& clipmap() const { return clipmap_; }

    void set(world::ChunkPos tile, const world::TintTile& colors);
    // Binds the tint for a frame from the camera; does nothing without a tint.
    void writeUniforms(const Camera& camera, gpu::MappedRing& ring) const;
    void addTo(gpu::TextureSet& textures) const;
    std::size_t gpuBytes() const { return textures_.sizeBytes(); }

  private:
    Clipmap clipmap_{kTintClipmap};
    gpu::Texture2DArray textures_;
    gpu::Sampler sampler_;
};

}  // namespace terrane::render
