// The land around the camera on the CPU: a clipmap of heights and colors (world/tint.h), and the data
// computed from it for shaders: shadows to the horizon, sky visibility, the color of the ground. Without
// OpenGL; used by LandTextures on one thread.
//
// A level is computed when all its tiles exist, the coarsest first, since finer ones need it at their border.
// Until then the level stays at its position and covers a little less around a moved camera. 1 ms a level if
// the light moved, 5 ms if the land is new.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "terrane/render/land/clipmap.h"
#include "terrane/shared/land.h"
#include "terrane/world/heights.h"
#include "terrane/world/tint.h"

namespace terrane::render {

// Shadows of land on land for a distant light are computed in one pass over a square of heights from the
// light's side on, each texel from the two nearest of the previous line. All functions are pure; any thread
// may call them. The shadow of a texel: points below `height` (blocks) are hidden from the light by land
// `distance` blocks away toward it.
struct LandShadow {
    float height, distance;
};
constexpr float kNoShadow = -1000.0f;  // blocks from the world's bottom: below all land

struct LandHeights {
    int side = 0;  // texels
    float texelBlocks = 1;
    std::span<const float> blocks;  // row after row
    float bottom = 0;               // of the world
};

// Computes the shadows. `direction` points to the light and has unit length. `outside` returns the shadow at
// a position outside the square, in texels; 0, 0 is the middle of the first texel. S(p) = max(H(q), S(q)) −
// |q − p| · tan(elevation), where q is the place on the previous line toward the light: the horizon as in
// Max, "Horizon mapping: shadows for bump-mapped surfaces", 1988, for one direction, in O(1) a texel.
void sweepShadows(const LandHeights& land, glm::vec3 direction,
                  const std::function<LandShadow(glm::vec2)>& outside, std::span<LandShadow> shadows);

// Computes the share of the sky that terrain forms of at least `minBlocks` leave visible, 0…1, row by row. It
// is 1 − the mean of sin² of the horizon's angle in eight directions.
void skyVisibility(const LandHeights& land, float minBlocks, std::span<float> visibility);

constexpr ClipmapShape kLandClipmap{static_cast<int>(shared::kLandLevels), shared::kLandFirstGeneratorLevel,
                                    1, TileOrder::CoarseFirst};

struct LandLight {
    glm::vec3 direction{0, 0, 1};  // to the sun or moon, unit length
    float discRadius = 0;          // radians
};

// Light begins at the height `begin` and is full `edge` blocks above.
struct LandEdge {
    float begin = 0, edge = 1;
};

// 256 × 256 texels row by row, not wrapped. Empty if the level does not exist.
struct LandLevel {
    glm::ivec2 corner{0};             // in the world, in texels of the level
    std::vector<float> heights, sky;  // blocks; visible share
    std::vector<float> roughness;     // largest error of heights, blocks
    std::vector<glm::vec3> ground;    // linear
    std::vector<LandShadow> shadows;
    std::vector<LandEdge> edges;  // of shadows, at the border those of the next level
    bool exists() const { return !edges.empty(); }
};

struct LandChange {
    int level = 0;
    bool hasNewGround = false;  // its place and ground changed too, not only shadows
    bool operator==(const LandChange&) const = default;
};

class LandMap {
  public:
    explicit LandMap(world::TopColors colors, world::Heights heights = {});
    world::Heights heights() const { return heights_; }
    // Edges of shadows begin from here on.
    float lowestEdge() const { return static_cast<float>(heights_.bottom) - shared::kLandBeyond; }
    const Clipmap& clipmap() const { return clipmap_; }
    const LandLevel& level(int level) const { return levels_[static_cast<std::size_t>(level)]; }

    // Sets the levels for a view of so many blocks; coarser levels are removed.
    void setReach(double blocks);
    double reach() const { return reach_; }
    void set(world::ChunkPos tile, const world::LandTile& land);
    // Computes up to `limit` levels that changed with the camera's place, new tiles or the light, and returns
    // them, the coarsest first.
    std::vector<LandChange> update(world::ChunkPos camera, const LandLight& light, int limit);

  private:
    static constexpr std::size_t kTexels = static_cast<std::size_t>(Clipmap::kTexels) * Clipmap::kTexels;
    struct Column {
        std::int16_t height = 0;
        std::array<std::uint8_t, 3> ground{};  // linear, 255 is 1
    };

    bool isComplete(int level, world::ChunkPos camera) const;
    bool canTakeColumns(int level, world::ChunkPos camera) const;
    glm::ivec2 cornerAt(int level, world::ChunkPos camera) const;
    void takeColumns(int level, glm::ivec2 corner);
    void sweep(int level);
    bool isSweeping() const;
    void blendEdges(int level);
    void blendGround(int level);
    const LandLevel* coarserThan(int level) const;

    Clipmap clipmap_{kLandClipmap};
    world::TopColors colors_;
    world::Heights heights_;
    std::vector<Column> columns_;  // wrapped, level after level
    std::array<LandLevel, shared::kLandLevels> levels_;
    std::array<bool, shared::kLandLevels> hasNewTiles_{}, needsSweep_{};
    LandLight light_;
    double reach_ = 0;
    int used_ = 1;  // levels
};

}  // namespace terrane::render
