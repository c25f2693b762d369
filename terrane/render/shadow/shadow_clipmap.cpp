#include "terrane/render/shadow/shadow_clipmap.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "terrane/render/land/clipmap.h"
#include "terrane/shared/mesh_section.h"

namespace terrane::render {
namespace {

constexpr int kShadowTiles = static_cast<int>(shared::kShadowTiles);
constexpr int kHalfShadowTiles = kShadowTiles / 2;
constexpr int kAnchorChunks = 64;
constexpr double kShadowLightStep = 1.0 / 128;  // radians, about
constexpr double kFirstTileBlocks = 14.5;
// Reach of a cascade in tiles: the middle of the tiles is up to half a tile beside the camera.
constexpr double kReachTiles = kHalfShadowTiles - 0.5;
// Largest width of a soft edge to each side, and the texels that filters read beyond a place, including the
// shift along the normal.
constexpr float kMostEdgeTexels = 5;
constexpr double kFilterTexels = 8;
// Frames that a changed tile of each cascade waits for further changes before it is drawn again, since chunks
// arrive one after the other.
constexpr std::array<std::uint64_t, shared::kShadowCascades> kPatience = {0, 8, 24};

// Rounds a direction to steps on the sides of a cube, independently of the direction before.
glm::dvec3 inSteps(glm::dvec3 direction) {
    const glm::dvec3 size = glm::abs(direction);
    const glm::dvec3 onCube = direction / std::max({size.x, size.y, size.z});
    return glm::normalize(glm::round(onCube / kShadowLightStep) * kShadowLightStep);
}

template <class F>
void forEachPlace(glm::ivec2 middle, const F& f) {
    for (int dy = -kHalfShadowTiles; dy < kHalfShadowTiles; ++dy)
        for (int dx = -kHalfShadowTiles; dx < kHalfShadowTiles; ++dx) f(middle + glm::ivec2(dx, dy));
}

}  // namespace

ShadowPlane shadowPlane(world::ChunkPos cameraChunk, glm::vec3 lightDirection) {
    return {lightAxes(inSteps(glm::dvec3(lightDirection))),
            {cameraChunk.x & ~(kAnchorChunks - 1), cameraChunk.y & ~(kAnchorChunks - 1)}};
}

glm::dvec3 onPlane(const ShadowPlane& plane, glm::dvec3 point) {
    return plane.toLight * (point - cornerOfChunk(plane.anchor));
}

double shadowTileBlocks(int cascade) {
    return std::ldexp(kFirstTileBlocks, 2 * cascade);
}

PlaneBox onPlane(const ShadowPlane& plane, const CasterBox& box) {
    const double width = double{world::kChunkSize} * world::columnWidth(box.chunk.level);
    const glm::dvec3 low(width * box.chunk.x, width * box.chunk.y, box.minZ);
    const glm::dvec3 high(low.x + width, low.y + width, box.maxZ);
    return onPlane(plane, low - double{shared::kWaving}, high + double{shared::kWaving});
}

PlaneBox onPlane(const ShadowPlane& plane, glm::dvec3 low, glm::dvec3 high) {
    const glm::dvec3 half = 0.5 * (high - low);
    const glm::dvec2 middle(onPlane(plane, 0.5 * (low + high)));
    const glm::dmat3& m = plane.toLight;
    const glm::dvec2 reach(glm::abs(m[0]) * half.x + glm::abs(m[1]) * half.y + glm::abs(m[2]) * half.z);
    return {middle - reach, middle + reach};
}

ShadowClipmap::Tile& ShadowClipmap::tileAt(Layer& layer, glm::ivec2 place) {
    const glm::ivec2 slot = place & (kTiles - 1);
    return layer.tiles[static_cast<std::size_t>(slot.x + kTiles * slot.y)];
}

const ShadowClipmap::Tile& ShadowClipmap::tileAt(const Layer& layer, glm::ivec2 place) {
    const glm::ivec2 slot = place & (kTiles - 1);
    return layer.tiles[static_cast<std::size_t>(slot.x + kTiles * slot.y)];
}

// The tile whose lower corner is the nearest one to the camera.
glm::ivec2 ShadowClipmap::middleOf(const Layer& layer, int cascade, const Camera& camera) {
    const glm::dvec2 at(onPlane(*layer.plane, camera.position));
    return glm::ivec2(glm::floor(at / shadowTileBlocks(cascade) + 0.5));
}

// Distance in blocks from the camera, along each axis of the plane, within which all tiles are drawn. Filters
// read farther: frame() subtracts that.
double ShadowClipmap::drawnReach(const Layer& layer, int cascade, const Camera& camera) {
    if (!layer.plane) return 0;
    const double blocks = shadowTileBlocks(cascade);
    const glm::dvec3 at = onPlane(*layer.plane, camera.position);
    double reach = kReachTiles * blocks;
    forEachPlace(middleOf(layer, cascade, camera), [&](glm::ivec2 place) {
        if (tileAt(layer, place).place == place) return;
        reach = std::min(
            reach, std::max(distanceToTile(at.x, place.x, blocks), distanceToTile(at.y, place.y, blocks)));
    });
    return reach;
}

void ShadowClipmap::markChanged(const CasterBox& box) {
    for (int cascade = 0; cascade < cascades_; ++cascade) {
        for (const std::size_t index : {inUse_[static_cast<std::size_t>(cascade)], spare_}) {
            Layer& layer = layers_[index];
            if (!layer.plane || (index == spare_ && next_ != cascade)) continue;
            // A texel has the depth at its center for half a texel around it.
            const double blocks = shadowTileBlocks(cascade), margin = 1.0 / 64;
            const PlaneBox covered = onPlane(*layer.plane, box);
            const glm::dvec2 low = glm::floor(covered.min / blocks - margin);
            const glm::dvec2 high = glm::floor(covered.max / blocks + margin);
            for (Tile& tile : layer.tiles) {
                if (!tile.place || tile.staleSince > 0) continue;
                const glm::dvec2 place(*tile.place);
                if (place.x >= low.x && place.x <= high.x && place.y >= low.y && place.y <= high.y)
                    tile.staleSince = frame_ + 1;
            }
        }
    }
}

// Starts a map again with the plane if nothing around the camera is drawn, or if all tiles are drawn at once.
// Otherwise one cascade at a time gets a new map beside the old one. A direction that changes faster than
// maps are drawn is skipped.
void ShadowClipmap::followLight(const Camera& camera, const ShadowPlane& plane, bool isAtOnce) {
    if (isAtOnce) next_ = -1;
    for (int cascade = 0; cascade < cascades_; ++cascade) {
        Layer& layer = used(cascade);
        if (layer.plane == plane || (!isAtOnce && drawnReach(layer, cascade, camera) > 0)) continue;
        layer = {plane, {}};
        if (next_ == cascade) next_ = -1;
    }
    for (int cascade = 0; next_ < 0 && cascade < cascades_; ++cascade) {
        if (used(cascade).plane == plane) continue;
        layers_[spare_] = {plane, {}};
        next_ = cascade;
    }
}

void ShadowClipmap::addMissing(std::vector<TileToDraw>& toDraw, int cascade, std::size_t layer,
                               const Camera& camera) const {
    const glm::ivec2 middle = middleOf(layers_[layer], cascade, camera);
    const auto begin = static_cast<std::ptrdiff_t>(toDraw.size());
    forEachPlace(middle, [&](glm::ivec2 place) {
        if (tileAt(layers_[layer], place).place != place) toDraw.push_back({cascade, layer, place});
    });
    const auto ring = [&](const TileToDraw& tile) {
        const glm::ivec2 away = tile.place - middle;
        return std::max({away.x, -1 - away.x, away.y, -1 - away.y});
    };
    std::ranges::stable_sort(toDraw.begin() + begin, toDraw.end(), {}, ring);
}

void ShadowClipmap::addStale(std::vector<TileToDraw>& toDraw, int cascade, const Camera& camera,
                             bool isAtOnce) const {
    const std::size_t layer = inUse_[static_cast<std::size_t>(cascade)];
    const std::uint64_t patience = isAtOnce ? 0 : kPatience[static_cast<std::size_t>(cascade)];
    forEachPlace(middleOf(layers_[layer], cascade, camera), [&](glm::ivec2 place) {
        const Tile& tile = tileAt(layers_[layer], place);
        if (tile.place == place && tile.staleSince > 0 && frame_ >= tile.staleSince + patience)
            toDraw.push_back({cascade, layer, place});
    });
}

// Every other frame a new map takes precedence over changes in the old ones, so that both progress.
std::vector<ShadowClipmap::TileToDraw> ShadowClipmap::tilesToDraw(const Camera& camera, bool isAtOnce) const {
    std::vector<TileToDraw> toDraw;
    for (int cascade = 0; cascade < cascades_; ++cascade)
        addMissing(toDraw, cascade, inUse_[static_cast<std::size_t>(cascade)], camera);
    const auto addNext = [&] {
        if (next_ >= 0) addMissing(toDraw, next_, spare_, camera);
    };
    if (frame_ % 2 == 0) addNext();
    for (int cascade = 0; cascade < cascades_; ++cascade) addStale(toDraw, cascade, camera, isAtOnce);
    if (frame_ % 2 == 1) addNext();
    return toDraw;
}

// Puts the finished new map into use. Tiles that changed since they were drawn stay marked as stale.
void ShadowClipmap::finishNext(const Camera& camera) {
    if (next_ < 0) return;
    std::vector<TileToDraw> missing;
    addMissing(missing, next_, spare_, camera);
    if (!missing.empty()) return;
    std::swap(inUse_[static_cast<std::size_t>(next_)], spare_);
    next_ = -1;
}

namespace {

bool follows(const ShadowTiles& a, const ShadowTiles& b, glm::ivec2 step) {
    return a.layer == b.layer && a.place + step * a.size == b.place && a.slot() + step * a.size == b.slot();
}

// Joins tiles into rows, then rows of equal width.
std::vector<ShadowTiles> joined(std::vector<ShadowTiles> tiles) {
    const auto key = [](const ShadowTiles& t) { return std::array{t.layer, t.slot().y, t.slot().x}; };
    std::ranges::sort(tiles, {}, key);
    std::vector<ShadowTiles> rows, all;
    for (const ShadowTiles& tile : tiles) {
        if (!rows.empty() && follows(rows.back(), tile, {1, 0})) {
            ++rows.back().size.x;
        } else {
            rows.push_back(tile);
        }
    }
    for (const ShadowTiles& row : rows) {
        const auto above = std::ranges::find_if(all, [&](const ShadowTiles& other) {
            return follows(other, row, {0, 1}) && other.size.x == row.size.x;
        });
        if (above != all.end()) {
            ++above->size.y;
        } else {
            all.push_back(row);
        }
    }
    return all;
}

}  // namespace

std::vector<ShadowTiles> ShadowClipmap::update(const Camera& camera, glm::vec3 lightDirection,
                                               std::size_t limit) {
    ++frame_;
    const bool isAtOnce = limit == kAllTiles;
    followLight(camera, shadowPlane(cameraChunk(camera), lightDirection), isAtOnce);
    std::vector<TileToDraw> toDraw = tilesToDraw(camera, isAtOnce);
    toDraw.resize(std::min(toDraw.size(), limit));
    std::vector<ShadowTiles> tiles;
    for (const TileToDraw& w : toDraw) {
        tileAt(layers_[w.layer], w.place) = {w.place, 0, frame_};
        tiles.push_back({*layers_[w.layer].plane, w.cascade, static_cast<int>(w.layer), w.place});
    }
    finishNext(camera);
    return joined(std::move(tiles));
}

NearestShadowMap ShadowClipmap::nearest() const {
    const Layer& layer = used(0);
    assert(layer.plane && "update() comes first");
    NearestShadowMap map{*layer.plane, static_cast<int>(inUse_[0]), {}};
    for (std::size_t slot = 0; slot < kShadowSlots; ++slot)
        map.tiles[slot] = {layer.tiles[slot].place, layer.tiles[slot].drawn};
    return map;
}

shared::ShadowFrame ShadowClipmap::frame(const Camera& camera, int texels) const {
    shared::ShadowFrame frame{};
    const glm::dvec3 corner = cornerOfChunk(cameraChunk(camera));
    for (int cascade = 0; cascade < kMaxCascades; ++cascade) {
        if (cascade >= cascades_) {
            frame.reach[cascade] = 1e9f;  // no such cascade
            continue;
        }
        const Layer& layer = used(cascade);
        assert(layer.plane && "update() comes first");
        const double blocks = kTiles * shadowTileBlocks(cascade), texel = blocks / texels;
        const glm::dmat3 rows = glm::transpose(layer.plane->toLight);
        const glm::dvec3 zero = onPlane(*layer.plane, corner);
        for (int axis = 0; axis < 2; ++axis) {
            const double offset = zero[axis] / blocks - std::floor(zero[axis] / blocks);
            frame.toMap[3 * cascade + axis] = glm::vec4(rows[axis] / blocks, offset);
        }
        const double range = shared::kShadowRange;
        frame.toMap[3 * cascade + 2] = glm::vec4(rows[2] / range, 0.5 + zero.z / range);
        const double reach = drawnReach(layer, cascade, camera) - kFilterTexels * texel;
        frame.reach[cascade] = static_cast<float>(reach > 0 ? 1 / reach : 1e9);
        frame.layers[cascade] = static_cast<float>(inUse_[static_cast<std::size_t>(cascade)]);
        frame.texels[cascade] = static_cast<float>(texel);
    }
    frame.texels[3] = kMostEdgeTexels;
    frame.mapTexels = static_cast<float>(texels);
    return frame;
}

}  // namespace terrane::render
