#include "terrane/render/land/clipmap.h"

#include <algorithm>
#include <cmath>

#include "terrane/base/result.h"

namespace terrane::render {
namespace {

static_assert(Clipmap::kTiles == shared::kTintTiles && Clipmap::kTexels == shared::kTintTexels);

constexpr int kHalfTiles = Clipmap::kTiles / 2;

// Calls f(tile) for the tiles of a level around its middle.
template <class F>
void forEachTile(world::ChunkPos middle, const F& f) {
    for (int dy = -kHalfTiles; dy < kHalfTiles; ++dy)
        for (int dx = -kHalfTiles; dx < kHalfTiles; ++dx) f(world::offsetBy(middle, dx, dy));
}

}  // namespace

double ClipmapShape::tileBlocks(int level) const {
    return world::kChunkSize * texelBlocks(level);
}

double ClipmapShape::texelBlocks(int level) const {
    return std::ldexp(1.0, generatorLevel(level));
}

Clipmap::Clipmap(const ClipmapShape& shape)
    : shape_(shape), tiles_(static_cast<std::size_t>(shape.levels) * kTiles * kTiles) {}

bool Clipmap::isTile(world::ChunkPos tile) const {
    const int above = tile.level - shape_.firstLevel;
    return above >= 0 && above % shape_.levelStep == 0 && above / shape_.levelStep < shape_.levels;
}

ClipmapPlace Clipmap::placeOf(world::ChunkPos tile) const {
    base::require(isTile(tile), "Clipmap: it has no tiles of this level");
    const int level = (tile.level - shape_.firstLevel) / shape_.levelStep;
    return {level, {16 * (tile.x & (kTiles - 1)), 16 * (tile.y & (kTiles - 1))}};
}

world::ChunkPos Clipmap::middleTile(int level, world::ChunkPos camera) const {
    const int k = shape_.generatorLevel(level);
    const std::int32_t half = std::int32_t{1} << (k - 1);
    return {(camera.x + half) >> k, (camera.y + half) >> k, static_cast<std::uint8_t>(k)};
}

int Clipmap::levelsFor(double reach) const {
    int levels = 1;
    while (levels < shape_.levels && 0.75 * kMaxReachTiles * shape_.tileBlocks(levels - 1) < reach) ++levels;
    return levels;
}

std::size_t Clipmap::slotOf(world::ChunkPos tile) const {
    const ClipmapPlace place = placeOf(tile);
    const glm::ivec2 slot = place.texel / 16;
    return static_cast<std::size_t>((place.level * kTiles + slot.y) * kTiles + slot.x);
}

bool Clipmap::contains(world::ChunkPos tile) const {
    return tiles_[slotOf(tile)] == tile;
}

void Clipmap::set(world::ChunkPos tile) {
    tiles_[slotOf(tile)] = tile;
}

std::vector<world::ChunkPos> Clipmap::missing(world::ChunkPos camera, double reach, std::size_t limit) const {
    const int levels = levelsFor(reach);
    const bool isCoarseFirst = shape_.order == TileOrder::CoarseFirst;
    std::vector<std::vector<world::ChunkPos>> groups(static_cast<std::size_t>(kHalfTiles * levels));
    for (int level = 0; level < levels; ++level) {
        const world::ChunkPos middle = middleTile(level, camera);
        forEachTile(middle, [&](world::ChunkPos tile) {
            if (contains(tile)) return;
            const int dx = tile.x - middle.x, dy = tile.y - middle.y;
            const int ring = std::max({dx, -1 - dx, dy, -1 - dy});
            const int group =
                isCoarseFirst ? kHalfTiles * (levels - 1 - level) + ring : ring * levels + level;
            groups[static_cast<std::size_t>(group)].push_back(tile);
        });
    }
    std::vector<world::ChunkPos> tiles;
    for (const auto& group : groups) {
        const std::size_t count = std::min(group.size(), limit - tiles.size());
        tiles.insert(tiles.end(), group.begin(), group.begin() + static_cast<std::ptrdiff_t>(count));
    }
    return tiles;
}

// Filters read half a texel beyond a place, so a whole texel is left as a margin.
double Clipmap::completeReach(int level, const Camera& camera) const {
    const double blocks = shape_.tileBlocks(level);
    double reach = kMaxReachTiles * blocks;
    forEachTile(middleTile(level, cameraChunk(camera)), [&](world::ChunkPos tile) {
        if (contains(tile)) return;
        const double away = std::max(distanceToTile(camera.position.x, tile.x, blocks),
                                     distanceToTile(camera.position.y, tile.y, blocks));
        reach = std::min(reach, away - shape_.texelBlocks(level));
    });
    return std::max(reach, 0.0);
}

shared::TintFrame tintFrame(const Clipmap& clipmap, const Camera& camera) {
    shared::TintFrame frame{};
    const world::ChunkPos chunk = cameraChunk(camera);
    for (int level = 0; level < clipmap.shape().levels; ++level) {
        const double period = Clipmap::kTiles * clipmap.shape().tileBlocks(level);
        const auto around = [&](std::int32_t corner) {
            const double chunks = period / world::kChunkSize;
            return static_cast<float>(corner / chunks - std::floor(corner / chunks));
        };
        frame.levels[level] = {around(chunk.x), around(chunk.y), static_cast<float>(1 / period),
                               static_cast<float>(clipmap.completeReach(level, camera))};
    }
    return frame;
}

double distanceToTile(double at, std::int32_t tile, double blocks) {
    const double low = tile * blocks;
    return std::max({0.0, low - at, at - (low + blocks)});
}

}  // namespace terrane::render
