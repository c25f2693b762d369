// Worlds in memory for the tests of areas.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "terrane/gen/generators/catalogue.h"
#include "terrane/store/overlay_store.h"
#include "terrane/volume/areas.h"
#include "terrane/volume/opened_world.h"
#include "tests/world/content_blocks.h"

namespace terrane::volume {

constexpr std::uint64_t kVolumeSeed = 7;

inline std::unique_ptr<OpenedWorld> openWorld(const std::string& generator,
                                              std::unique_ptr<store::ChunkStore> store,
                                              unsigned threads = 2) {
    auto blocks = std::make_unique<const world::BlockRegistry>(contentBlocks());
    auto generators = gen::makeLevelGenerators(generator, *blocks, kVolumeSeed);
    auto world =
        OpenedWorld::create({std::move(blocks), std::move(generators).value(), std::move(store), threads});
    return std::move(world).value();
}

inline std::unique_ptr<OpenedWorld> openWorld(const std::string& generator, unsigned threads = 2) {
    const store::WorldIdentity identity{kVolumeSeed, generator,
                                        gen::versionOf(gen::builtInGenerators(), generator)};
    return openWorld(generator, std::make_unique<store::MemoryStore>(identity), threads);
}

// An area whose corners lie anywhere in chunks.
inline BlockArea randomArea(std::mt19937& random) {
    const auto number = [&](int low, int high) { return std::uniform_int_distribution(low, high)(random); };
    const int x = number(-50, 50), y = number(-50, 50), z = number(0, 250);
    return {x, y, z, x + number(1, 40), y + number(1, 40), std::min(256, z + number(1, 256))};
}

inline std::vector<world::BlockId> blocksOf(OpenedWorld& world, const BlockArea& area) {
    std::vector<world::BlockId> blocks(static_cast<std::size_t>(area.blockCount()));
    const auto read = readBlocks(world, area, blocks, {});
    EXPECT_TRUE(read) << read.error().message;
    return blocks;
}

// Calls use(x, y, z, place in the area's array) for each block.
template <class Use>
void forEachBlock(const BlockArea& area, const Use& use) {
    std::size_t place = 0;
    for (std::int64_t z = area.z0; z < area.z1; ++z)
        for (std::int64_t y = area.y0; y < area.y1; ++y)
            for (std::int64_t x = area.x0; x < area.x1; ++x) use(x, y, z, place++);
}

inline world::ChunkPos chunkAtBlock(std::int64_t x, std::int64_t y) {
    return {static_cast<std::int32_t>(x >> 4), static_cast<std::int32_t>(y >> 4)};
}

}  // namespace terrane::volume
