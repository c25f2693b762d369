// Which part of the tint (world/tint.h) is there around the camera: levels of 16 × 16 tiles each, whose
// texels are four times as wide from level to level (shared/tint.h). A tile is a chunk of its generator
// level.
//
// A level wraps around: a tile lies at its position modulo 16, so that a camera that moves on replaces only
// the tiles that it left behind. Plain bookkeeping without OpenGL; one thread.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "terrane/render/camera.h"
#include "terrane/shared/tint.h"
#include "terrane/world/coords.h"

namespace terrane::render {

// Where a tile lies in the clipmap's textures.
struct TintPlace {
    int level = 0;        // of the clipmap
    glm::ivec2 texel{0};  // its first one
};

class TintClipmap {
  public:
    // A chunk of a generator level that the clipmap has.
    static bool isTile(world::ChunkPos tile);
    static TintPlace placeOf(world::ChunkPos tile);

    // Tiles that are missing around the camera's chunk, near and fine ones first, up to `limit`; those that
    // something `reach` blocks away needs. They may lie outside of the world.
    std::vector<world::ChunkPos> missing(world::ChunkPos camera, double reach, std::size_t limit) const;
    // The tile is there, in place of the one that was.
    void set(world::ChunkPos tile);

    // What shaders need of it as it is now.
    shared::TintFrame frame(const Camera& camera) const;

  private:
    static constexpr int kTiles = static_cast<int>(shared::kTintTiles);
    static constexpr int kLevels = static_cast<int>(shared::kTintLevels);

    const std::optional<world::ChunkPos>& at(int level, world::ChunkPos tile) const;
    double completeReach(int level, const Camera& camera) const;

    std::array<std::array<std::optional<world::ChunkPos>, static_cast<std::size_t>(kTiles) * kTiles>, kLevels>
        tiles_;
};

}  // namespace terrane::render
