#include "terrane/render/tint_clipmap.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace terrane::render {
namespace {

constexpr int kHalfTiles = static_cast<int>(shared::kTintTiles) / 2;
// A level is used up to 7 tiles from the camera: it stands up to half a tile beside the middle of the 16.
constexpr double kMaxReachTiles = kHalfTiles - 1;

int generatorLevel(int level) {
    return shared::tintGeneratorLevel(level);
}

double tileBlocks(int level) {
    return std::ldexp(1.0, generatorLevel(level) + 4);  // 16 columns
}

double texelBlocks(int level) {
    return std::ldexp(1.0, generatorLevel(level));
}

// The tile whose lower corner is the nearest one to the chunk: the middle of the level's tiles.
world::ChunkPos middleTile(int level, world::ChunkPos chunk) {
    const int k = generatorLevel(level);
    const std::int32_t half = std::int32_t{1} << (k - 1);
    return {(chunk.x + half) >> k, (chunk.y + half) >> k, static_cast<std::uint8_t>(k)};
}

// Calls f(tile) for the tiles of a level around its middle.
template <class F>
void forEachTile(int level, world::ChunkPos chunk, const F& f) {
    const world::ChunkPos middle = middleTile(level, chunk);
    for (int dy = -kHalfTiles; dy < kHalfTiles; ++dy)
        for (int dx = -kHalfTiles; dx < kHalfTiles; ++dx) f({middle.x + dx, middle.y + dy, middle.level});
}

// How far a point is from a tile along one axis, blocks.
double distanceTo(double at, std::int32_t tile, double blocks) {
    const double low = tile * blocks;
    return std::max({0.0, low - at, at - (low + blocks)});
}

}  // namespace

bool TintClipmap::isTile(world::ChunkPos tile) {
    return tile.level >= 2 && tile.level % 2 == 0 && tile.level <= generatorLevel(kLevels - 1);
}

TintPlace TintClipmap::placeOf(world::ChunkPos tile) {
    assert(isTile(tile) && "the clipmap has the level");
    return {tile.level / 2 - 1, {16 * (tile.x & (kTiles - 1)), 16 * (tile.y & (kTiles - 1))}};
}

const std::optional<world::ChunkPos>& TintClipmap::at(int level, world::ChunkPos tile) const {
    const glm::ivec2 slot = placeOf(tile).texel / 16;
    return tiles_[static_cast<std::size_t>(level)][static_cast<std::size_t>(slot.x + kTiles * slot.y)];
}

void TintClipmap::set(world::ChunkPos tile) {
    const TintPlace place = placeOf(tile);
    const glm::ivec2 slot = place.texel / 16;
    tiles_[static_cast<std::size_t>(place.level)][static_cast<std::size_t>(slot.x + kTiles * slot.y)] = tile;
}

std::vector<world::ChunkPos> TintClipmap::missing(world::ChunkPos camera, double reach,
                                                  std::size_t limit) const {
    std::array<std::vector<world::ChunkPos>, kHalfTiles> byRing;
    for (int level = 0; level < kLevels; ++level) {
        // The level before reaches as far as is asked for.
        if (level > 0 && 0.75 * kMaxReachTiles * tileBlocks(level - 1) >= reach) break;
        const world::ChunkPos middle = middleTile(level, camera);
        forEachTile(level, camera, [&](world::ChunkPos tile) {
            if (at(level, tile) == tile) return;
            const int dx = tile.x - middle.x, dy = tile.y - middle.y;
            const int ring = std::max({dx, -1 - dx, dy, -1 - dy});
            byRing[static_cast<std::size_t>(ring)].push_back(tile);
        });
    }
    std::vector<world::ChunkPos> tiles;
    for (const auto& ring : byRing) {
        const std::size_t count = std::min(ring.size(), limit - tiles.size());
        tiles.insert(tiles.end(), ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(count));
    }
    return tiles;
}

// Filters read half a texel beyond a place: a whole one stays between.
double TintClipmap::completeReach(int level, const Camera& camera) const {
    const double blocks = tileBlocks(level);
    double reach = kMaxReachTiles * blocks;
    forEachTile(level, cameraChunk(camera), [&](world::ChunkPos tile) {
        if (at(level, tile) == tile) return;
        const double away = std::max(distanceTo(camera.position.x, tile.x, blocks),
                                     distanceTo(camera.position.y, tile.y, blocks));
        reach = std::min(reach, away - texelBlocks(level));
    });
    return std::max(reach, 0.0);
}

shared::TintFrame TintClipmap::frame(const Camera& camera) const {
    shared::TintFrame frame{};
    const world::ChunkPos chunk = cameraChunk(camera);
    for (int level = 0; level < kLevels; ++level) {
        const double period = kTiles * tileBlocks(level);
        const auto around = [&](std::int32_t corner) {
            const double chunks = period / world::kChunkSize;
            return static_cast<float>(corner / chunks - std::floor(corner / chunks));
        };
        frame.levels[level] = {around(chunk.x), around(chunk.y), static_cast<float>(1 / period),
                               static_cast<float>(completeReach(level, camera))};
    }
    return frame;
}

}  // namespace terrane::render
