// Generators, surfaces and chunks for the tests of maps.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <ostream>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>

#include "terrane/gen/generators/catalogue.h"
#include "terrane/map/surface.h"
#include "tests/world/content_blocks.h"

namespace terrane::world {

inline void PrintTo(ChunkPos pos, std::ostream* out) {
    *out << "chunk (" << pos.x << ", " << pos.y << ") of level " << int{pos.level};
}

}  // namespace terrane::world

namespace terrane::map {

inline void PrintTo(const SurfaceColumn& column, std::ostream* out) {
    *out << column.top << " at " << column.topZ << " over " << column.under << " at " << column.underZ;
}

constexpr std::uint64_t kMapSeed = 1;

// Generators of one seed, made once for all tests.
inline const gen::LevelGenerators& generatorsOf(const std::string& name) {
    static std::map<std::string, gen::LevelGenerators> made;
    const auto found = made.find(name);
    if (found != made.end()) return found->second;
    auto generators = gen::makeLevelGenerators(name, contentBlocks(), kMapSeed);
    if (!generators) throw std::runtime_error(generators.error().message);
    return made.emplace(name, std::move(*generators)).first->second;
}

// Generators that fail: surfaces must come from elsewhere.
inline const gen::LevelGenerators& noGenerators() {
    static const gen::LevelGenerators none(
        [](int) -> base::Result<gen::GeneratorGraph> { return base::fail("nothing is generated here"); },
        kMapSeed);
    return none;
}

inline const SurfaceKinds& contentKinds() {
    static const SurfaceKinds kinds = surfaceKinds(contentBlocks());
    return kinds;
}

inline Surface generatedSurface(const gen::LevelGenerators& generators, world::ChunkPos pos) {
    return surfaceOf(generators.generate(pos), contentKinds());
}

// The generator's chunk with a pillar of a block on it, up to z = 200.
inline world::ChunkPtr chunkWithPillar(const gen::LevelGenerators& generators, world::ChunkPos pos, int x,
                                       int y, std::string_view block) {
    auto chunk = std::make_shared<world::Chunk>(generators.generate(pos));
    for (int z = 60; z <= 200; ++z) chunk->setBlock(world::blockIndex(x, y, z), contentBlock(block));
    return chunk;
}

inline SurfaceColumn randomColumn(std::mt19937& random) {
    const auto randomHeight = [&] {
        return static_cast<std::int16_t>(world::kLowestBottom +
                                         static_cast<int>(random() % world::kMostLayers));
    };
    return {static_cast<world::BlockId>(random()), static_cast<world::BlockId>(random()), randomHeight(),
            randomHeight()};
}

}  // namespace terrane::map
