#include "terrane/render/land/land_map.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/render/quads/block_textures.h"

namespace terrane::render {

namespace {

// Shadows of a light at the horizon would be endless.
constexpr float kMinSlope = 0.01f;
constexpr float kOverhead = 1e-3f;  // a light straight above casts none

// Order of a sweep over the square: line by line away from the light.
struct Walk {
    bool isAlongX;    // a line is a column
    int first, step;  // lines
    float sideways;   // texels along a line from a texel to its q, -1…1
};

Walk walkFrom(glm::vec3 direction, int side) {
    Walk walk{};
    walk.isAlongX = std::abs(direction.x) >= std::abs(direction.y);
    const float major = walk.isAlongX ? direction.x : direction.y;
    const float minor = walk.isAlongX ? direction.y : direction.x;
    walk.first = major > 0 ? side - 1 : 0;
    walk.step = major > 0 ? -1 : 1;
    walk.sideways = minor / std::abs(major);
    return walk;
}

// The higher of a texel's land and its shadow, with one more texel at both ends: texel k of the line is at k
// + 1.
struct Line {
    std::vector<float> top, distance;
};

void setFromOutside(Line& line, std::size_t at, const LandShadow& shadow) {
    line.top[at] = shadow.height;
    line.distance[at] = shadow.distance;
}

}  // namespace

void sweepShadows(const LandHeights& land, glm::vec3 direction,
                  const std::function<LandShadow(glm::vec2)>& outside, std::span<LandShadow> shadows) {
    const auto side = static_cast<std::size_t>(land.side);
    base::require(land.blocks.size() == side * side && shadows.size() == land.blocks.size(),
                  "sweepShadows: heights and shadows are squares of one size");
    const float across = std::hypot(direction.x, direction.y);
    if (across < kOverhead) {
        std::ranges::fill(shadows, LandShadow{land.bottom + kNoShadow, 0});
        return;
    }
    const Walk walk = walkFrom(direction, land.side);
    const float stride = land.texelBlocks * std::hypot(1.0f, walk.sideways);
    const float drop = stride * std::max(direction.z / across, kMinSlope);
    const std::size_t shift = walk.sideways < 0 ? 0 : 1;  // of q's first texel
    const float share = walk.sideways - std::floor(walk.sideways) + (walk.sideways == 1.0f ? 1.0f : 0.0f);
    const auto texel = [&](int line, std::size_t k) {
        const auto l = static_cast<std::size_t>(line);
        return walk.isAlongX ? k * side + l : l * side + k;
    };
    const auto outsideAt = [&](int line, int k) {
        const glm::vec2 place(line, k);
        return outside(walk.isAlongX ? place : glm::vec2(place.y, place.x));
    };

    Line before{std::vector<float>(side + 2), std::vector<float>(side + 2)}, now = before;
    for (int k = -1; k <= land.side; ++k)
        setFromOutside(before, static_cast<std::size_t>(k + 1), outsideAt(walk.first - walk.step, k));
    for (int n = 0; n < land.side; ++n) {
        const int line = walk.first + n * walk.step;
        for (std::size_t k = 0; k < side; ++k) {
            const std::size_t q = k + shift;
            const float height = before.top[q] + share * (before.top[q + 1] - before.top[q]) - drop;
            const float distance =
                before.distance[q] + share * (before.distance[q + 1] - before.distance[q]) + stride;
            const float here = land.blocks[texel(line, k)];
            shadows[texel(line, k)] = {height, distance};
            now.top[k + 1] = std::max(here, height);
            now.distance[k + 1] = here >= height ? 0.0f : distance;
        }
        setFromOutside(now, 0, outsideAt(line, -1));
        setFromOutside(now, side + 1, outsideAt(line, land.side));
        std::swap(before, now);
    }
}

namespace {

// Raises the tangents of the horizon to that of the land `away` (texels).
void raiseHorizon(const LandHeights& land, glm::ivec2 away, std::span<float> tangents) {
    const float scale =
        1.0f / (land.texelBlocks * std::hypot(static_cast<float>(away.x), static_cast<float>(away.y)));
    const int firstX = std::max(0, -away.x), endX = std::min(land.side, land.side - away.x);
    const int firstY = std::max(0, -away.y), endY = std::min(land.side, land.side - away.y);
    const std::ptrdiff_t offset = static_cast<std::ptrdiff_t>(away.y) * land.side + away.x;
    for (int y = firstY; y < endY; ++y) {
        const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(y) * land.side;
        const float* from = land.blocks.data() + row;
        float* to = tangents.data() + row;
        for (int x = firstX; x < endX; ++x) to[x] = std::max(to[x], (from[x + offset] - from[x]) * scale);
    }
}

constexpr int kDirections = 8;
constexpr int kDistances = 6;  // each twice the one before

}  // namespace

void skyVisibility(const LandHeights& land, float minBlocks, std::span<float> visibility) {
    base::require(visibility.size() == land.blocks.size(), "skyVisibility: each texel needs a value");
    std::ranges::fill(visibility, 1.0f);
    std::vector<float> tangents(visibility.size());
    for (int k = 0; k < kDirections; ++k) {
        const float angle = 2 * 3.14159265f * static_cast<float>(k) / kDirections;
        std::ranges::fill(tangents, 0.0f);
        for (int n = 0; n < kDistances; ++n) {
            const float texels = std::ldexp(minBlocks, n) / land.texelBlocks;
            const float used = n == 0 ? std::max(texels, 1.0f) : texels;
            if (used < 1.0f || used > static_cast<float>(land.side) / 4) continue;
            const glm::ivec2 away(std::lround(used * std::cos(angle)), std::lround(used * std::sin(angle)));
            raiseHorizon(land, away, tangents);
        }
        for (std::size_t p = 0; p < tangents.size(); ++p) {
            const float square = tangents[p] * tangents[p];
            visibility[p] -= square / (1 + square) / kDirections;
        }
    }
}

namespace {

constexpr int kSide = Clipmap::kTexels;
// The sun moves this far in 0.3 s of a day of 20 minutes; 1/50 of its diameter.
constexpr float kLandLightStep = 0.0018f;  // radians
constexpr float kMinForm = 16;             // blocks: light levels and ambient occlusion shade smaller forms
constexpr float kBlockError = 0.75f;       // blocks: heights are integers
constexpr float kBlendBegins = 0.75f;      // share of half a side from which a level blends into the next one
constexpr float kBlendEnds = 0.92f;        // below kLandUsed, since filters read beyond a place

// Place of a texel of a level in the next one, in its texels from the middle of the first one.
glm::vec2 inCoarser(const LandLevel& fine, const LandLevel& coarse, glm::vec2 texel) {
    return (glm::vec2(fine.corner - 2 * coarse.corner) + texel + 0.5f) / 2.0f - 0.5f;
}

// Calls f(index, weight) for the four texels around a place; places outside the level use its border.
template <class F>
void forFourAround(glm::vec2 place, const F& f) {
    const glm::vec2 at = glm::clamp(place, glm::vec2(0), glm::vec2(kSide - 1.001f));
    const glm::ivec2 low(at);
    const glm::vec2 share = at - glm::vec2(low);
    for (int k = 0; k < 4; ++k) {
        const int dx = k & 1, dy = k >> 1;
        const float weight = (dx == 1 ? share.x : 1 - share.x) * (dy == 1 ? share.y : 1 - share.y);
        f(static_cast<std::size_t>((low.y + dy) * kSide + low.x + dx), weight);
    }
}

LandShadow shadowAt(const LandLevel& level, glm::vec2 place) {
    LandShadow sum{0, 0};
    forFourAround(place, [&](std::size_t k, float weight) {
        const LandShadow& s = level.shadows[k];
        const bool isLand = level.heights[k] >= s.height;
        sum.height += weight * std::max(level.heights[k], s.height);
        sum.distance += weight * (isLand ? 0.0f : s.distance);
    });
    return sum;
}

// A quarter of the height range of the 3 × 3 texels: the largest error of the height within a texel.
float roughnessAt(std::span<const float> heights, int x, int y) {
    float low = 1e9f, high = -1e9f;
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, kSide - 1); ++v) {
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, kSide - 1); ++u) {
            const float h = heights[static_cast<std::size_t>(v * kSide + u)];
            low = std::min(low, h);
            high = std::max(high, h);
        }
    }
    return (high - low) / 4;
}

// Calls f(x, y, share) for texels that blend into the next level, so that no ring is visible.
template <class F>
void forBorder(const F& f) {
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const glm::vec2 away = glm::abs(glm::vec2(x, y) + 0.5f - 0.5f * kSide) / (0.5f * kSide);
            const float share = glm::smoothstep(kBlendBegins, kBlendEnds, std::max(away.x, away.y));
            if (share > 0) f(x, y, share);
        }
    }
}

// Half of the disc is visible at the height of the shadow. Heights may be off by `error`: surfaces that much
// lower are lit too.
LandEdge edgeOf(const LandShadow& shadow, float roughness, float discRadius, float lowest) {
    const float error = roughness + kBlockError;
    const float half = std::min(std::tan(discRadius) * shadow.distance, (shared::kLandMaxEdge - error) / 2);
    return {std::max(shadow.height - error - half, lowest), error + 2 * half};
}

}  // namespace

LandMap::LandMap(world::TopColors colors, world::Heights heights)
    : colors_(std::move(colors)), heights_(heights), columns_(kTexels * shared::kLandLevels) {}

void LandMap::setReach(double blocks) {
    reach_ = blocks;
    const int used = clipmap_.levelsFor(blocks);
    if (used == used_) return;
    for (std::size_t level = static_cast<std::size_t>(used); level < levels_.size(); ++level) {
        levels_[level] = {};
        hasNewTiles_[level] = true;  // tiles that the clipmap still has
    }
    // The former coarsest level now has a coarser one at its border.
    if (used > used_ && used_ > 0) hasNewTiles_[static_cast<std::size_t>(used_ - 1)] = true;
    used_ = used;
    needsSweep_.fill(true);
}

void LandMap::set(world::ChunkPos tile, const world::LandTile& land) {
    const ClipmapPlace place = clipmap_.placeOf(tile);
    std::unordered_map<world::BlockId, std::array<std::uint8_t, 3>> seen;
    const auto colorOf = [&](world::BlockId id) {
        const auto [found, isNew] = seen.try_emplace(id);
        if (!isNew || id >= colors_.size()) return found->second;
        const world::TopColor& top = colors_[id];
        const glm::vec3 srgb = top.tinted ? world::tinted(top.mean / 255.0f, land.tint) : top.mean / 255.0f;
        for (std::size_t c = 0; c < 3; ++c)
            found->second[c] = static_cast<std::uint8_t>(255 * decodeSrgb(srgb[static_cast<int>(c)]) + 0.5f);
        return found->second;
    };
    const std::size_t first = kTexels * static_cast<std::size_t>(place.level);
    for (std::size_t k = 0; k < world::LandTile::kColumns; ++k) {
        const auto x = static_cast<std::size_t>(place.texel.x) + k % 16;
        const auto y = static_cast<std::size_t>(place.texel.y) + k / 16;
        columns_[first + y * kSide + x] = {land.height[k], colorOf(land.ground[k])};
    }
    clipmap_.set(tile);
    hasNewTiles_[static_cast<std::size_t>(place.level)] = true;
}

bool LandMap::isComplete(int level, world::ChunkPos camera) const {
    const world::ChunkPos middle = clipmap_.middleTile(level, camera);
    for (int dy = -Clipmap::kTiles / 2; dy < Clipmap::kTiles / 2; ++dy)
        for (int dx = -Clipmap::kTiles / 2; dx < Clipmap::kTiles / 2; ++dx)
            if (!clipmap_.contains(world::offsetBy(middle, dx, dy))) return false;
    return true;
}

glm::ivec2 LandMap::cornerAt(int level, world::ChunkPos camera) const {
    const world::ChunkPos middle = clipmap_.middleTile(level, camera);
    return world::kChunkSize * (glm::ivec2(middle.x, middle.y) - Clipmap::kTiles / 2);
}

// After the camera has moved to other tiles, some of them are new.
bool LandMap::canTakeColumns(int number, world::ChunkPos camera) const {
    return hasNewTiles_[static_cast<std::size_t>(number)] && isComplete(number, camera);
}

void LandMap::takeColumns(int number, glm::ivec2 corner) {
    LandLevel& level = levels_[static_cast<std::size_t>(number)];
    level.corner = corner;
    level.heights.resize(kTexels);
    level.ground.resize(kTexels);
    const Column* columns = columns_.data() + kTexels * static_cast<std::size_t>(number);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const int wrapped = ((corner.y + y) & (kSide - 1)) * kSide + ((corner.x + x) & (kSide - 1));
            const Column& column = columns[wrapped];
            const auto k = static_cast<std::size_t>(y * kSide + x);
            level.heights[k] = column.height;
            level.ground[k] = glm::vec3(column.ground[0], column.ground[1], column.ground[2]) / 255.0f;
        }
    }
    level.sky.resize(kTexels);
    const LandHeights land{kSide, static_cast<float>(kLandClipmap.texelBlocks(number)), level.heights};
    skyVisibility(land, kMinForm, level.sky);
    level.roughness.resize(kTexels);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            level.roughness[static_cast<std::size_t>(y * kSide + x)] = roughnessAt(level.heights, x, y);
    blendGround(number);
}

void LandMap::sweep(int number) {
    LandLevel& level = levels_[static_cast<std::size_t>(number)];
    const LandLevel* coarser = coarserThan(number);
    const LandHeights land{kSide, static_cast<float>(kLandClipmap.texelBlocks(number)), level.heights,
                           static_cast<float>(heights_.bottom)};
    const auto outside = [&](glm::vec2 place) {
        return coarser ? shadowAt(*coarser, inCoarser(level, *coarser, place))
                       : LandShadow{land.bottom + kNoShadow, 0};
    };
    level.shadows.resize(kTexels);
    sweepShadows(land, light_.direction, outside, level.shadows);
    level.edges.resize(kTexels);
    for (std::size_t k = 0; k < kTexels; ++k)
        level.edges[k] = edgeOf(level.shadows[k], level.roughness[k], light_.discRadius, lowestEdge());
    blendEdges(number);
}

const LandLevel* LandMap::coarserThan(int number) const {
    return number + 1 < used_ ? &levels_[static_cast<std::size_t>(number) + 1] : nullptr;
}

// Beyond the last level there is open land.
void LandMap::blendEdges(int number) {
    LandLevel& level = levels_[static_cast<std::size_t>(number)];
    const LandLevel* coarser = coarserThan(number);
    forBorder([&](int x, int y, float share) {
        LandEdge edge{0, 0};
        if (!coarser) edge.begin = lowestEdge();
        if (coarser) {
            forFourAround(inCoarser(level, *coarser, {x, y}), [&](std::size_t k, float weight) {
                edge.begin += weight * coarser->edges[k].begin;
                edge.edge += weight * coarser->edges[k].edge;
            });
        }
        LandEdge& own = level.edges[static_cast<std::size_t>(y * kSide + x)];
        own = {glm::mix(own.begin, edge.begin, share), glm::mix(own.edge, edge.edge, share)};
    });
}

void LandMap::blendGround(int number) {
    LandLevel& level = levels_[static_cast<std::size_t>(number)];
    const LandLevel* coarser = coarserThan(number);
    forBorder([&](int x, int y, float share) {
        const auto k = static_cast<std::size_t>(y * kSide + x);
        glm::vec4 next(coarser ? glm::vec3(0) : level.ground[k], coarser ? 0.0f : 1.0f);
        if (coarser) {
            forFourAround(inCoarser(level, *coarser, {x, y}), [&](std::size_t at, float weight) {
                next += weight * glm::vec4(coarser->ground[at], coarser->sky[at]);
            });
        }
        level.ground[k] = glm::mix(level.ground[k], glm::vec3(next), share);
        level.sky[k] = glm::mix(level.sky[k], next.w, share);
    });
}

std::vector<LandChange> LandMap::update(world::ChunkPos camera, const LandLight& light, int limit) {
    const bool isOther = glm::distance(light.direction, light_.direction) > kLandLightStep ||
                         light.discRadius != light_.discRadius;
    // Light that moves faster than all levels are swept skips steps, so that the finest level gets its turn.
    if (isOther && (limit >= used_ || !isSweeping())) {
        light_ = light;
        needsSweep_.fill(true);
    }
    std::vector<LandChange> changed;
    for (int number = used_ - 1; number >= 0 && static_cast<int>(changed.size()) < limit; --number) {
        const auto n = static_cast<std::size_t>(number);
        if (number + 1 < used_ && !levels_[n + 1].exists()) break;
        const bool hasNewGround = canTakeColumns(number, camera);
        if (hasNewGround) {
            takeColumns(number, cornerAt(number, camera));
            hasNewTiles_[n] = false;
            needsSweep_[n] = true;
        }
        if (levels_[n].heights.empty() || !needsSweep_[n]) continue;
        sweep(number);
        needsSweep_[n] = false;
        if (number > 0) needsSweep_[n - 1] = true;
        changed.push_back({number, hasNewGround});
    }
    return changed;
}

// Whether the last light has not reached all levels.
bool LandMap::isSweeping() const {
    for (std::size_t n = 0; n < static_cast<std::size_t>(used_); ++n)
        if (needsSweep_[n] && !levels_[n].heights.empty()) return true;
    return false;
}

}  // namespace terrane::render
