// Tracks the parts of the shadow maps that are drawn, and those to draw again. Cascades of 50, 200 and 800
// blocks around the camera are squares in the plane across the light, 8 × 8 tiles each.
//
// A tile has a place in the plane and is stored in its map at that place modulo 8: a moving camera replaces
// only the tiles that it leaves behind, a turning one none. The plane counts from an anchor that the camera
// seldom leaves, and the light's direction moves in steps. If either changes, a cascade's new map is drawn
// into a spare layer while the old one stays in use, so that no map mixes two directions.
//
// It uses no OpenGL; one thread uses it.
#pragma once

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "terrane/render/frame/camera.h"
#include "terrane/shared/shadow.h"

namespace terrane::render {

// Returns the matrix whose rows are unit axes: x and y across the light, z toward it. `toward`: to the light,
// unit length.
template <class T>
glm::mat<3, 3, T, glm::defaultp> lightAxes(const glm::vec<3, T, glm::defaultp>& toward) {
    using Vec3 = glm::vec<3, T, glm::defaultp>;
    const Vec3 other = std::abs(toward.z) < static_cast<T>(0.9) ? Vec3(0, 0, 1) : Vec3(1, 0, 0);
    const Vec3 across = glm::normalize(glm::cross(other, toward));
    return glm::transpose(glm::mat<3, 3, T, glm::defaultp>(across, glm::cross(toward, across), toward));
}

// Axes across the light and along it, and their origin.
struct ShadowPlane {
    glm::dmat3 toLight{1};  // × (point − anchor): x and y across the light, z toward it
    world::ChunkPos anchor;

    bool operator==(const ShadowPlane&) const = default;
};

// Returns the plane of a light whose direction is rounded to steps of 1/128 rad: in one step a shadow moves
// by one texel of its cascade if the caster is 7, 29 or 116 blocks away.
ShadowPlane shadowPlane(world::ChunkPos cameraChunk, glm::vec3 lightDirection);
// Returns the coordinates of a point (blocks) in the plane.
glm::dvec3 onPlane(const ShadowPlane& plane, glm::dvec3 point);

// Returns the width of a tile in blocks. A cascade reaches at least 3.5 tiles from the camera.
double shadowTileBlocks(int cascade);

// A mesh section that casts shadows or did.
struct CasterBox {
    world::ChunkPos chunk;
    int minZ = 0, maxZ = 0;
};

// Bounds of a box in the plane, blocks; waves included for mesh sections.
struct PlaneBox {
    glm::dvec2 min, max;
};
PlaneBox onPlane(const ShadowPlane& plane, const CasterBox& box);
PlaneBox onPlane(const ShadowPlane& plane, glm::dvec3 low, glm::dvec3 high);  // of a box in blocks

// A rectangle of tiles that are contiguous in the map, to be drawn together.
struct ShadowTiles {
    ShadowPlane plane;
    int cascade = 0, layer = 0;
    glm::ivec2 place{0}, size{1};  // tiles

    glm::ivec2 slot() const { return place & (static_cast<int>(shared::kShadowTiles) - 1); }
};

constexpr std::size_t kShadowSlots = std::size_t{shared::kShadowTiles} * shared::kShadowTiles;

// The map of the nearest cascade that is in use.
struct NearestShadowMap {
    struct Tile {
        std::optional<glm::ivec2> place;
        std::uint64_t drawn = 0;  // number of the update that drew it; 0: none
    };
    ShadowPlane plane;
    int layer = 0;
    std::array<Tile, kShadowSlots> tiles;  // by slot: x + kShadowTiles × y
};

class ShadowClipmap {
  public:
    // Most tiles of a frame in a window: a moving light requests 3 × 64 tiles about once a second, a walking
    // camera few.
    static constexpr std::size_t kTilesPerFrame = 4, kAllTiles = SIZE_MAX;

    explicit ShadowClipmap(int cascades = 0)
        : cascades_(cascades), spare_(static_cast<std::size_t>(cascades)) {}
    int cascades() const { return cascades_; }
    // Returns the number of layers: one more than there are cascades.
    int layers() const { return cascades_ + 1; }

    // Marks the tiles that the shadow of the box falls on as stale.
    void markChanged(const CasterBox& box);
    // Selects up to `limit` tiles around the camera, missing and near ones first; they count as drawn from
    // now on. With kAllTiles nothing is missing or stale afterwards.
    std::vector<ShadowTiles> update(const Camera& camera, glm::vec3 lightDirection, std::size_t limit);

    // Returns the uniforms of the maps in their present state. `texels`: along a side of a map.
    shared::ShadowFrame frame(const Camera& camera, int texels) const;
    NearestShadowMap nearest() const;  // after update()

  private:
    static constexpr int kTiles = static_cast<int>(shared::kShadowTiles);
    static constexpr int kMaxCascades = static_cast<int>(shared::kShadowCascades);

    struct Tile {
        std::optional<glm::ivec2> place;  // none: nothing is drawn
        std::uint64_t staleSince = 0;     // number of the update after the change; 0: up to date
        std::uint64_t drawn = 0;          // number of the update that drew it
    };
    struct Layer {
        std::optional<ShadowPlane> plane;
        std::array<Tile, kShadowSlots> tiles;
    };
    // A tile that is to be drawn.
    struct TileToDraw {
        int cascade = 0;
        std::size_t layer = 0;
        glm::ivec2 place{0};
    };

    static Tile& tileAt(Layer& layer, glm::ivec2 place);
    static const Tile& tileAt(const Layer& layer, glm::ivec2 place);
    Layer& used(int cascade) { return layers_[inUse_[static_cast<std::size_t>(cascade)]]; }
    const Layer& used(int cascade) const { return layers_[inUse_[static_cast<std::size_t>(cascade)]]; }
    static glm::ivec2 middleOf(const Layer& layer, int cascade, const Camera& camera);
    static double drawnReach(const Layer& layer, int cascade, const Camera& camera);
    void followLight(const Camera& camera, const ShadowPlane& plane, bool isAtOnce);
    void addMissing(std::vector<TileToDraw>& toDraw, int cascade, std::size_t layer,
                    const Camera& camera) const;
    void addStale(std::vector<TileToDraw>& toDraw, int cascade, const Camera& camera, bool isAtOnce) const;
    std::vector<TileToDraw> tilesToDraw(const Camera& camera, bool isAtOnce) const;
    void finishNext(const Camera& camera);

    int cascades_;
    std::array<Layer, kMaxCascades + 1> layers_;
    std::array<std::size_t, kMaxCascades> inUse_{0, 1, 2};
    std::size_t spare_;
    int next_ = -1;  // the cascade that the spare layer is drawn for
    std::uint64_t frame_ = 0;
};

}  // namespace terrane::render
