// Which parts of the shadow maps are drawn, and which must be drawn again. Cascades of 50, 200 and 800 blocks
// around the camera are squares in the plane across the light, 8 × 8 tiles each.
//
// A tile has a place in the plane and lies in its map at that place modulo 8: a camera that moves on replaces
// only the tiles that it left behind, one that turns none. The plane counts from an anchor that the camera
// seldom leaves, and the light's direction moves in steps. Where either changes, a cascade's new map is drawn
// into a spare layer while the old one stays in use, so that no map mixes two directions.
//
// Plain bookkeeping without OpenGL; one thread.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "terrane/render/camera.h"
#include "terrane/shared/shadow.h"

namespace terrane::render {

// The axes across the light and along it, and where their zero lies.
struct ShadowPlane {
    glm::dmat3 toLight{1};  // × (point − anchor): x and y across the light, z toward it
    world::ChunkPos anchor;

    bool operator==(const ShadowPlane&) const = default;
};

// Of a light in steps of 1/128 rad: a caster's shadow moves by a texel of its cascade at a time where it is
// 7, 29 and 116 blocks away.
ShadowPlane shadowPlane(world::ChunkPos cameraChunk, glm::vec3 lightDirection);
// Of a point in blocks.
glm::dvec3 onPlane(const ShadowPlane& plane, glm::dvec3 point);

// Width of a tile in blocks. From the middle of its tiles a cascade reaches 3.5 of them at least.
double shadowTileBlocks(int cascade);

// A mesh section that casts shadows or did.
struct CasterBox {
    world::ChunkPos chunk;
    int minZ = 0, maxZ = 0;
};

// What a box covers of the plane, blocks; with what waves.
struct PlaneBox {
    glm::dvec2 min, max;
};
PlaneBox onPlane(const ShadowPlane& plane, const CasterBox& box);
PlaneBox onPlane(const ShadowPlane& plane, glm::dvec3 low, glm::dvec3 high);  // of a box in blocks

// A rectangle of tiles that follow each other in the map, to be drawn together.
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
    // Of a frame in a window: a light that moves asks for 3 × 64 tiles about once a second, a walk for few.
    static constexpr std::size_t kTilesAFrame = 4, kAllTiles = SIZE_MAX;

    explicit ShadowClipmap(int cascades = 0)
        : cascades_(cascades), spare_(static_cast<std::size_t>(cascades)) {}
    int cascades() const { return cascades_; }
    // One more than there are cascades.
    int layers() const { return cascades_ + 1; }

    // The shadows of what was or is there are others than before.
    void markChanged(const CasterBox& box);
    // Chooses up to `limit` tiles around the camera, those that are missing and near first; they count as
    // drawn from now on. With kAllTiles nothing is missing or stale afterward.
    std::vector<ShadowTiles> update(const Camera& camera, glm::vec3 lightDirection, std::size_t limit);

    // What shaders need of it as it is now. `texels`: along a side of a map.
    shared::ShadowFrame frame(const Camera& camera, int texels) const;
    NearestShadowMap nearest() const;  // after update()

  private:
    static constexpr int kTiles = static_cast<int>(shared::kShadowTiles);
    static constexpr int kMaxCascades = static_cast<int>(shared::kShadowCascades);

    struct Tile {
        std::optional<glm::ivec2> place;  // none: nothing is drawn
        std::uint64_t staleSince = 0;     // frame; 0: as it should be
        std::uint64_t drawn = 0;          // frame
    };
    struct Layer {
        std::optional<ShadowPlane> plane;
        std::array<Tile, kShadowSlots> tiles;
    };
    // A tile that is to be drawn.
    struct Wanted {
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
    void addMissing(std::vector<Wanted>& wanted, int cascade, std::size_t layer, const Camera& camera) const;
    void addStale(std::vector<Wanted>& wanted, int cascade, const Camera& camera, bool isAtOnce) const;
    std::vector<Wanted> wantedTiles(const Camera& camera, bool isAtOnce) const;
    void finishNext(const Camera& camera);

    int cascades_;
    std::array<Layer, kMaxCascades + 1> layers_;
    std::array<std::size_t, kMaxCascades> inUse_{0, 1, 2};
    std::size_t spare_;
    int next_ = -1;  // the cascade that the spare layer is drawn for
    std::uint64_t frame_ = 0;
};

}  // namespace terrane::render
