// The land around the camera as textures (shared/land.h): one layer of 256² texels a level, 4.2 MB, or 6.3 in
// worlds of more than 1,792 layers. The renderer uses it on the context's thread.
#pragma once

#include "terrane/gpu/mapped_ring.h"
#include "terrane/gpu/texture.h"
#include "terrane/render/land/land_map.h"

namespace terrane::render {

class LandTextures {
  public:
    static constexpr int kAllLevels = static_cast<int>(shared::kLandLevels);

    LandTextures() = default;  // none
    static LandTextures create(world::TopColors colors, world::Heights heights);
    bool isUsed() const { return shadows_.id() != 0; }
    LandMap& map() { return map_; }
    const LandMap& map() const { return map_; }

    // Computes and uploads up to `limit` levels that changed for this camera and light.
    void update(const Camera& camera, const LandLight& light, int limit);
    void writeUniforms(const Camera& camera, gpu::MappedRing& ring) const;
    void addTo(gpu::TextureSet& textures) const;
    std::size_t gpuBytes() const { return shadows_.sizeBytes() + ground_.sizeBytes(); }

  private:
    LandMap map_{{}};
    gpu::Texture2DArray shadows_, ground_;
    gpu::Sampler sampler_;
};

shared::LandFrame landFrame(const LandMap& map, const Camera& camera);

}  // namespace terrane::render
