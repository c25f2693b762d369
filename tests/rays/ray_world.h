// Small worlds of chunks and tiles of several levels, and a slow walk from block to block through them, which
// the rays of shared/ray_cast.h must equal to the bit.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <unordered_map>

#include "terrane/rays/scene.h"

namespace terrane::rays {

constexpr world::BlockId kStone = 1, kGrass = 2;
inline const StopTable kStops{0, 1, 0};  // air and grass let rays pass

struct RayWorld {
    world::Heights heights{-32, 80};
    int levels = 1, sideBits = 4;
    world::ChunkPos center{};
    std::unordered_map<world::ChunkPos, world::Chunk, world::ChunkPosHash> tiles;

    Scene scene() const {
        Scene made = makeScene(heights, levels, sideBits);
        moveScene(made, center);
        for (const auto& [pos, chunk] : tiles) setTile(made, pos, buildColumn(chunk, kStops));
        return made;
    }
};

// A section of a kind: air, stone, few or many stones, a plane, a cube of 4³, or grass everywhere.
inline world::Section randomSection(std::mt19937& random) {
    std::array<world::Section::Value, world::kBlocksPerSection> values{};
    const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
    const int kind = below(9), plane = below(16), x4 = below(4), y4 = below(4), z4 = below(4);
    const unsigned rarity = 1u << below(10);
    for (int k = 0; k < world::kBlocksPerSection; ++k) {
        const int x = k & 15, y = k >> 4 & 15, z = k >> 8;
        bool isStone = kind == 1;
        if (kind == 2 || kind == 3) isStone = random() % rarity == 0;
        if (kind == 4) isStone = random() % rarity != 0;
        if (kind == 5) isStone = z <= plane;
        if (kind == 6) isStone = x >> 2 == x4 && y >> 2 == y4 && z >> 2 == z4;
        if (kind == 7) isStone = x == plane;
        values[static_cast<std::size_t>(k)] = isStone                   ? kStone
                                              : kind == 8 || k % 7 == 0 ? kGrass
                                                                        : world::kAir;
    }
    return world::Section::fromValues(values);
}

inline world::Chunk randomChunk(world::Heights heights, std::mt19937& random) {
    world::Chunk chunk(heights);
    const int top = static_cast<int>(random() % static_cast<unsigned>(heights.sections() + 1));
    for (int k = 0; k < top; ++k) chunk.setSection(heights.firstSection() + k, randomSection(random));
    return chunk;
}

// Chunks around the center, a ring of tiles of each level around these, and places that nothing covers.
inline RayWorld worldAround(world::ChunkPos center, std::mt19937& random, int levels) {
    RayWorld made;
    made.levels = levels;
    made.center = center;
    const auto divide = [&](auto& self, world::ChunkPos tile) -> void {
        const world::ChunkPos middle{made.center.x >> tile.level, made.center.y >> tile.level, tile.level};
        if (random() % 12 == 0 || !world::isInWorld(tile)) return;
        if (tile.level == 0 || world::chunkDistance(tile, middle) > 1) {
            made.tiles.emplace(tile, randomChunk(made.heights, random));
            return;
        }
        for (int k = 0; k < 4; ++k) {
            self(self, {2 * tile.x + k % 2, 2 * tile.y + k / 2, static_cast<std::uint8_t>(tile.level - 1)});
        }
    };
    const auto top = static_cast<std::uint8_t>(levels - 1);
    for (const world::ChunkPos tile :
         world::chunksWithin({made.center.x >> top, made.center.y >> top, top}, 2))
        divide(divide, tile);
    return made;
}

inline RayWorld randomWorld(std::mt19937& random, int levels) {
    const auto anywhere = [&] { return static_cast<std::int32_t>(random() % 2000) - 1000; };
    const std::int32_t x = anywhere(), y = anywhere();
    return worldAround({x, y}, random, levels);
}

// Anywhere in the middle of the world, in any direction: also along axes, along diagonals, from edges of
// blocks.
inline shared::Ray randomRay(const RayWorld& made, std::mt19937& random) {
    const auto within = [&](int low, int high) {
        return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
    };
    const auto component = [&]() -> float {
        switch (random() % 8) {
            case 0:
                return 0;
            case 1:
                return 1;
            case 2:
                return -1;
            case 3:
                return static_cast<float>(within(-4, 4));
            case 4:
                return std::ldexp(static_cast<float>(within(-999, 999)), -within(8, 40));
            default:
                return std::ldexp(static_cast<float>(within(-(1 << 22), 1 << 22)), -22);
        }
    };
    const auto place = [&]() -> float {
        const float places[4] = {0, 1, .5f, .25f};
        const unsigned kind = random() % 8;
        return kind < 4 ? places[kind] : std::ldexp(static_cast<float>(within(0, 1 << 24)), -24);
    };
    const int reach = 40;
    const int inside = 16 * (made.center.x == world::kMaxChunk ? -3 : 0);  // not beyond the edge of the world
    const glm::ivec4 cell{made.center.x * 16 + inside + within(-reach, reach),
                          made.center.y * 16 + within(-reach, reach),
                          within(made.heights.bottom - 8, made.heights.top + 8), 0};
    const float end = random() % 4 == 0 ? static_cast<float>(within(0, 200)) : 1e9f;
    return shared::makeRay(cell, {place(), place(), place(), 0}, {component(), component(), component(), 0},
                           end);
}

// What stops a ray at a block: the level of the tile, or -1 if nothing does, or -2 outside of the scene.
inline int stopAt(const RayWorld& made, const Scene& scene, glm::ivec4 cell) {
    const auto top = static_cast<std::uint8_t>(made.levels - 1);
    if (!isInWindow(scene, {cell.x >> (4 + top), cell.y >> (4 + top), top})) return -2;
    if (!made.heights.contains(cell.z)) return -1;
    for (int level = 0; level < made.levels; ++level) {
        const auto found =
            made.tiles.find({cell.x >> (4 + level), cell.y >> (4 + level), static_cast<std::uint8_t>(level)});
        if (found == made.tiles.end()) continue;
        const world::BlockId id =
            found->second.block(world::blockIndex(cell.x >> level & 15, cell.y >> level & 15, cell.z));
        return id >= kStops.size() || kStops[id] != 0 ? level : -1;
    }
    return -1;
}

// Block by block, through the plane with the smallest t.
inline shared::RayHit slowCast(const RayWorld& made, const Scene& scene, const shared::Ray& ray) {
    shared::RayHit hit{};
    hit.face = shared::kRayMiss;
    glm::ivec3 passed(0);
    int axis = shared::kRayBegins;
    for (float t = 0; t <= ray.start.w;) {
        const glm::ivec4 mirrored(glm::uvec4(ray.cell) + glm::uvec4(glm::uvec3(passed), 0));
        const glm::ivec4 cell = mirrored ^ ray.mirror;
        const int level = stopAt(made, scene, cell);
        if (level == -2) return hit;
        if (ray.mirror.z != 0 ? cell.z < made.heights.bottom : cell.z >= made.heights.top) return hit;
        if (level >= 0) {
            hit = {cell, shared::kRayFaceNone, t, level, 0};
            if (axis != shared::kRayBegins)
                hit.face = static_cast<shared::uint>(2 * axis + (ray.mirror[axis] == 0 ? 0 : 1));
            return hit;
        }
        float next[3];
        for (int a = 0; a < 3; ++a)
            next[a] = (static_cast<float>(passed[a] + 1) - ray.start[a]) * ray.inverse[a];
        axis = next[0] <= next[1] && next[0] <= next[2] ? 0 : next[1] <= next[2] ? 1 : 2;
        t = next[axis];
        ++passed[axis];
    }
    return hit;
}

inline bool isSame(const shared::RayHit& a, const shared::RayHit& b) {
    if (a.face != b.face) return false;
    return a.face == shared::kRayMiss || (a.cell == b.cell && a.level == b.level &&
                                          shared::floatBitsToUint(a.t) == shared::floatBitsToUint(b.t));
}

}  // namespace terrane::rays
