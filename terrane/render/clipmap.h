// Which tiles of a clipmap are there around the camera: levels of 16 × 16 tiles each, whose texels are wider
// from level to level. A tile is a chunk of its generator level, and a texel one of its columns. The tint
// (tint_textures.h) and the land (land_map.h) have one each.
//
// A level wraps around: a tile lies at its position modulo 16, so that a camera that moves on replaces only
// the tiles that it left behind. Plain bookkeeping without OpenGL; one thread.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "terrane/render/camera.h"
#include "terrane/shared/tint.h"
#include "terrane/world/coords.h"

namespace terrane::render {

// Where a tile lies in the clipmap's textures.
struct ClipmapPlace {
    int level = 0;        // of the clipmap
    glm::ivec2 texel{0};  // its first one
};

enum class TileOrder : std::uint8_t {
    NearFirst,    // rings of tiles around the camera, fine levels first
    CoarseFirst,  // the coarsest level first: fine tiles change what coarse ones show
};

// Level l has the columns of the generator's level firstLevel + l · levelStep.
struct ClipmapShape {
    int levels = 1, firstLevel = 0, levelStep = 1;
    TileOrder order = TileOrder::NearFirst;

    int generatorLevel(int level) const { return firstLevel + levelStep * level; }
    double tileBlocks(int level) const;
    double texelBlocks(int level) const;
};

class Clipmap {
  public:
    static constexpr int kTiles = 16;    // along a side of a level
    static constexpr int kTexels = 256;  // the same in texels
    // A level is used up to 7 tiles from the camera: it stands up to half a tile beside the middle of the 16.
    static constexpr double kMaxReachTiles = kTiles / 2 - 1;

    explicit Clipmap(const ClipmapShape& shape);
    const ClipmapShape& shape() const { return shape_; }

    // A chunk of a generator level that the clipmap has.
    bool isTile(world::ChunkPos tile) const;
    ClipmapPlace placeOf(world::ChunkPos tile) const;
    // Of the 16 × 16 tiles of a level around the camera's chunk: the one whose lower corner is in the middle.
    world::ChunkPos middleTile(int level, world::ChunkPos camera) const;
    // How many of the levels, from the finest on, are needed to see so many blocks far.
    int levelsFor(double reach) const;

    // Tiles that are missing around the camera's chunk up to `limit`, those that something `reach` blocks
    // away needs. They may lie outside of the world.
    std::vector<world::ChunkPos> missing(world::ChunkPos camera, double reach, std::size_t limit) const;
    bool contains(world::ChunkPos tile) const;
    // The tile is there, in place of the one that was.
    void set(world::ChunkPos tile);

    // How far from the camera a level is complete along each axis, blocks; at most kMaxReachTiles tiles.
    double completeReach(int level, const Camera& camera) const;

  private:
    std::size_t slotOf(world::ChunkPos tile) const;

    ClipmapShape shape_;
    std::vector<std::optional<world::ChunkPos>> tiles_;  // level after level
};

// What shaders need of the tint's clipmap as it is now.
constexpr ClipmapShape kTintClipmap{static_cast<int>(shared::kTintLevels), shared::tintGeneratorLevel(0), 2};
shared::TintFrame tintFrame(const Clipmap& clipmap, const Camera& camera);

}  // namespace terrane::render
