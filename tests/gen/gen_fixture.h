// Helpers for tests of the generator: block types, functions that run recorded passes, every instruction set.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "terrane/gen/cpu/kernels.h"
#include "terrane/gen/generator.h"
#include "terrane/gen/language/builder.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/chunk.h"
#include "terrane/world/coords.h"
#include "tests/support/default_heights.h"
#include "tests/support/depth.h"
#include "tests/world/content_blocks.h"

namespace terrane::world {

inline void PrintTo(ChunkPos pos, std::ostream* out) {
    *out << "chunk (" << pos.x << ", " << pos.y << ")";
    if (pos.level > 0) *out << " of level " << int{pos.level};
}

}  // namespace terrane::world

namespace terrane::gen {

using world::BlockId;
using world::ChunkPos;

using Write = std::function<void(GeneratorBuilder&)>;

inline world::BlockRegistry parseBlocks(std::string_view toml, std::string_view name) {
    auto registry = world::BlockRegistry::parse(toml, name);
    EXPECT_TRUE(registry.has_value()) << (registry ? "" : registry.error().message);
    return registry ? std::move(*registry) : world::BlockRegistry();
}

// stone is 1, dirt is 2, water is 3.
inline const world::BlockRegistry& testBlocks() {
    static const world::BlockRegistry registry = parseBlocks(R"(
[[block]]
name = "stone"
shape = "cube"
texture = "stone"
[[block]]
name = "dirt"
shape = "cube"
texture = "dirt"
[[block]]
name = "water"
shape = "liquid"
texture = "water"
alpha = "blend"
opacity = 1
)",
                                                             "test blocks");
    return registry;
}

inline base::Result<GeneratorGraph> tryToBuild(const Write& write, GraphRequest request = {}) {
    GeneratorBuilder builder("test", testBlocks(), request);
    write(builder);
    return builder.finish();
}

inline GeneratorGraph build(const Write& write, GraphRequest request = {}) {
    auto graph = tryToBuild(write, request);
    EXPECT_TRUE(graph.has_value()) << (graph ? "" : graph.error().message);
    return graph ? std::move(*graph) : GeneratorGraph();
}

// Around the origin, and the corners of the world: ±2^31 blocks.
constexpr std::array<ChunkPos, 6> kPlaces = {{{0, 0},
                                              {-1, -1},
                                              {7, -12},
                                              {world::kMinChunk, world::kMinChunk},
                                              {world::kMaxChunk, world::kMaxChunk},
                                              {world::kMinChunk, world::kMaxChunk}}};

// The chunks of a level that hold the first blocks of those places, and the corners of the world.
inline std::array<ChunkPos, 6> placesOf(int level) {
    std::array<ChunkPos, 6> places = kPlaces;
    for (ChunkPos& pos : places) {
        pos = {pos.x >> level, pos.y >> level, static_cast<std::uint8_t>(level)};
    }
    return places;
}

// Heights that worlds may have, small ones at all ends and the tallest one.
constexpr std::array<world::Heights, 6> kSomeHeights = {
    {{0, 256}, {-64, 320}, {512, 1024}, {-2048, -2032}, {2032, 2048}, {-2048, 2048}}};

// From the bottom of the world.
inline std::vector<BlockId> blocksOf(const world::Chunk& chunk) {
    const world::Heights heights = chunk.heights();
    std::vector<BlockId> ids(static_cast<std::size_t>(heights.layers()) * world::kBlocksPerLayer);
    for (int s = 0; s < heights.sections(); ++s) {
        const std::span all(ids);
        chunk.section(heights.firstSection() + s)
            .unpack(all.subspan(static_cast<std::size_t>(s) * world::kBlocksPerSection)
                        .first<world::kBlocksPerSection>());
    }
    return ids;
}

// The place of block `index` of blocksOf().
inline world::BlockPos placeOf(ChunkPos chunk, world::Heights heights, std::size_t index) {
    return world::blockPos(chunk,
                           static_cast<world::BlockIndex>(index) + world::blockIndex(0, 0, heights.bottom));
}

// The block at (x, y, z); its lower 16 bits count.
using ExpectedBlock = std::function<std::int32_t(std::int32_t x, std::int32_t y, std::int32_t z)>;

inline void expectChunk(const Generator& generator, ChunkPos pos, const ExpectedBlock& expected) {
    const std::vector<BlockId> ids = blocksOf(generator.generate(pos));
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const world::BlockPos at = placeOf(pos, generator.heights(), i);
        const auto want = static_cast<BlockId>(expected(at.x, at.y, at.z));
        ASSERT_EQ(ids[i], want) << "at (" << at.x << ", " << at.y << ", " << at.z << ")";
    }
}

// A cache of this many chunks, however much memory they need.
inline CacheSize chunks(std::size_t count) {
    return {.bytes = 0, .minChunks = count};
}

constexpr std::uint64_t kTestSeed = 42;

inline const std::uint32_t kRandomCases = atDepth(60u, 200u);

inline void expectBlocks(const Write& write, const ExpectedBlock& expected, GraphRequest request = {}) {
    const Generator generator(build(write, request), kTestSeed);
    for (const ChunkPos pos : kPlaces) {
        SCOPED_TRACE(testing::PrintToString(pos));
        expectChunk(generator, pos, expected);
        if (testing::Test::HasFatalFailure()) return;
    }
}

// The same for a generator of one 3D pass whose block is the lower half of a number.
inline void expectNumbers(const std::function<Int(Pass&)>& write, const ExpectedBlock& expected) {
    const auto pass = [&](Pass& p) { p.setBlock(Block(write(p))); };
    expectBlocks([&](GeneratorBuilder& g) { g.pass3D("numbers", pass); }, expected);
}

// Calls f for each instruction set the machine has, then goes back to the best one.
template <class Function>
void onEachTarget(Function f) {
    for (const std::string& target : simdTargets()) {
        SCOPED_TRACE(target);
        EXPECT_TRUE(chooseSimdTarget(target));
        f();
        if (testing::Test::HasFatalFailure()) break;
    }
    EXPECT_TRUE(chooseSimdTarget(""));
}

// Arithmetic modulo 2^32, which is no undefined behavior like that of `int`.
constexpr std::int32_t wrapped(std::int64_t v) {
    return static_cast<std::int32_t>(static_cast<std::uint64_t>(v));
}

}  // namespace terrane::gen
