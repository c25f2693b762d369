// Random block sources for the tests of the mesher: the same number always gives the same blocks.
#pragma once

#include <cmath>
#include <string_view>
#include <vector>

#include "terrane/shared/hash.h"
#include "tests/mesh/mesh_fixture.h"

namespace terrane::mesh {

enum class Mix {
    Everything,    // each block any type
    Sparse,        // one block in 50
    Dense,         // air one block in 50, opaque cubes most of the others
    Checkerboard,  // two types alternate
    Terrain,       // hills, sea, leaves, plants
    Transparent,   // only types one sees through, in lumps
    Lumps,         // boxes of a few blocks
    Slabs,         // horizontal layers of one type each, some blocks exchanged
    UnknownIds,    // thousands of ids, so that sections are dense
    Count,
};

inline unsigned hashAt(int x, int y, int z, unsigned seed) {
    return shared::hash3(static_cast<unsigned>(x), static_cast<unsigned>(y), static_cast<unsigned>(z), seed);
}

inline world::BlockId anyId(unsigned hash) {
    return static_cast<world::BlockId>(hash % testBlocks().types().size());
}

inline world::BlockId terrainAt(int x, int y, int z, unsigned seed) {
    const float phase = static_cast<float>(seed % 100);
    const float fx = static_cast<float>(x), fy = static_cast<float>(y);
    const int height = static_cast<int>(40 + 9 * std::sin(fx / 7 + phase) + 7 * std::cos(fy / 5 - phase));
    const unsigned hash = hashAt(x, y, z, seed);
    if (z < height) return hash % 37 == 0 ? idOf("ore") : idOf("stone");
    if (z < 42) return idOf("water");
    if (z == height && hash % 6 == 0) return hash % 5 == 0 ? idOf("cactus") : idOf("tuft");
    if (z > height + 4 && z < height + 9 && hashAt(x / 4, y / 4, 0, seed) % 3 == 0) {
        return hash % 4 == 0 ? world::kAir : idOf("leaves");
    }
    return world::kAir;
}

inline world::BlockId transparentAt(int x, int y, int z, unsigned seed) {
    static constexpr std::string_view kNames[] = {"leaves", "water", "glass", "grate", "lattice", "pillar"};
    const unsigned hash = hashAt(x >> 1, y >> 1, z >> 1, seed) % 8;
    return hash < 6 ? idOf(kNames[hash]) : hash == 6 ? idOf("stone") : world::kAir;
}

inline world::BlockId slabAt(int x, int y, int z, unsigned seed) {
    const unsigned hash = hashAt(x, y, z, seed);
    return anyId(hash % 60 == 0 ? hash / 60 : hashAt(0, 0, z, seed) % 97);
}

inline BlockSource randomBlocks(Mix mix, unsigned seed) {
    return [mix, seed](int x, int y, int z) -> world::BlockId {
        const unsigned hash = hashAt(x, y, z, seed);
        switch (mix) {
            case Mix::Everything:
                return anyId(hash);
            case Mix::Sparse:
                return hash % 50 == 0 ? anyId(hash / 50) : world::kAir;
            case Mix::Dense:
                return hash % 50 == 0 ? world::kAir : hash % 10 == 0 ? anyId(hash / 10) : idOf("stone");
            case Mix::Checkerboard:
                return anyId(hashAt((x + y + z) & 1, 0, 0, seed));
            case Mix::Terrain:
                return terrainAt(x, y, z, seed);
            case Mix::Transparent:
                return transparentAt(x, y, z, seed);
            case Mix::Lumps:
                return anyId(hashAt(x >> 2, y / 5, z / 3, seed));
            case Mix::Slabs:
                return slabAt(x, y, z, seed);
            case Mix::UnknownIds:
                return z < 48 ? static_cast<world::BlockId>(hash % 700) : world::kAir;
            case Mix::Count:
                break;
        }
        return world::kAir;
    };
}

}  // namespace terrane::mesh
