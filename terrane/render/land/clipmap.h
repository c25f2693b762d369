// Tracks the tiles of a clipmap around the camera: levels of 16 × 16 tiles each, whose texels get wider from
// level to level. A tile is a chunk of its generator level, and a texel one of its columns. The tint
// (tint_textures.h) and the land (land_map.h) have one clipmap each.
//
// A level wraps around: a tile is stored at its position modulo 16, so that a moving camera replaces only the
// tiles that it leaves behind. It uses no OpenGL; one thread uses it.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "terrane/render/frame/camera.h"
#include "terrane/shared/tint.h"
#include "terrane/world/coords.h"

namespace terrane::render {

// Place of a tile in the clipmap's textures.
struct ClipmapPlace {
    int level = 0;        // of the clipmap
    glm::ivec2 texel{0};  // the first one of the tile
};

enum class TileOrder : std::uint8_t {
    NearFirst,    // rings of tiles around the camera, fine levels first
    CoarseFirst,  // the coarsest level first; fine tiles refine it
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
    // A level is used up to 7 tiles from the camera, which is up to half a tile beside the middle of the 16.
    static constexpr double kMaxReachTiles = kTiles / 2 - 1;

    explicit Clipmap(const ClipmapShape& shape);
    const ClipmapShape& shape() const { return shape_; }

    // Returns whether it is a chunk of a generator level that the clipmap has.
    bool isTile(world::ChunkPos tile) const;
    ClipmapPlace placeOf(world::ChunkPos tile) const;
    // Returns the tile whose lower corner is the middle of the 16 × 16 tiles of a level around the camera's
    // chunk.
    world::ChunkPos middleTile(int level, world::ChunkPos camera) const;
    // Returns the number of levels, from the finest on, that a view of `reach` blocks needs.
    int levelsFor(double reach) const;

    // Returns up to `limit` tiles that are missing around the camera's chunk for a view of `reach` blocks.
    // They may lie outside of the world.
    std::vector<world::ChunkPos> missing(world::ChunkPos camera, double reach, std::size_t limit) const;
    bool contains(world::ChunkPos tile) const;
    // Stores the tile, which replaces the one at its place.
    void set(world::ChunkPos tile);

    // Returns the distance from the camera along each axis up to which a level is complete, blocks; at most
    // kMaxReachTiles tiles.
    double completeReach(int level, const Camera& camera) const;

  private:
    std::size_t slotOf(world::ChunkPos tile) const;

    ClipmapShape shape_;
    std::vector<std::optional<world::ChunkPos>> tiles_;  // level after level
};

// The clipmap of the tint, and its uniforms.
constexpr ClipmapShape kTintClipmap{static_cast<int>(shared::kTintLevels), shared::tintGeneratorLevel(0), 2};
shared::TintFrame tintFrame(const Clipmap& clipmap, const Camera& camera);

// Returns the distance of a point from tile number `tile` along one axis; `blocks`: width of a tile.
double distanceToTile(double at, std::int32_t tile, double blocks);

}  // namespace terrane::render
