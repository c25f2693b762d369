#include "terrane/gen/generator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/gen/gen_fixture.h"

namespace terrane::gen {
namespace {

// Every kind of pass and read: a chunk depends on chunks three away.
void writeDeep(GeneratorBuilder& g) {
    const auto a = g.field<Float>("a"), b = g.field<Float>("b"), d = g.field<Float>("d");
    const auto c = g.field<Int>("c");
    g.pass2D("a", [&](Pass& p) { p.set(a, p.perlin2D("hills", 16, {1.0f, 2.0f})); });
    g.pass2D("b", [&](Pass& p) { p.set(b, p.readAt(a, {16, 0}) + p.readAt(a, {-16, -16}) * 0.5f); });
    g.pass3D("ground", [&](Pass& p) {
        const Bool isGround = Float(p.z()) < p.readAt(b, {0, 16}) * 30.0f + 100.0f;
        p.setBlock(select(isGround, p.block("stone"), p.block("air")));
    });
    g.pass2D("c", [&](Pass& p) {
        const Bool isHigh = p.blockInColumn(110) == p.block("stone");
        p.set(c, select(isHigh, Int(p.readAt(b, {-16, 16}) * 100.0f), p.voronoi2D("cells", 20, 2).offset.x));
        p.set(d, p.readAt(b, {5, -16}) + p.random2D("r", p.x(), p.y()));
    });
    g.pass3D("cover", [&](Pass& p) {
        Var<Block> block = p.var(p.blockHere());
        p.if_(p.readAt(d, {16, 16}) > 0.25f && p.blockHere() == p.block("air"), [&] {
            const Bool isSpot = p.perlin3D("spots", 8, {1.0f}) > 0.1f;
            block = select(isSpot, Block(p.readAt(c, {-16, -16}) & 0xFF), static_cast<Block>(block));
        });
        p.setBlock(block);
    });
}

void writeFlatStone(GeneratorBuilder& g) {
    g.pass3D("only", [](Pass& p) { p.setBlock(select(p.z() < 60, p.block("stone"), p.block("air"))); });
}

// A square of 4×4 chunks with its south-west corner at `corner`.
std::vector<ChunkPos> square(ChunkPos corner) {
    std::vector<ChunkPos> result;
    for (int k = 0; k < 16; ++k) result.push_back({corner.x + k % 4, corner.y + k / 4});
    return result;
}

using Chunks = std::vector<std::vector<BlockId>>;

Chunks generateAll(const Generator& generator, const std::vector<ChunkPos>& positions) {
    Chunks chunks;
    for (const ChunkPos pos : positions) chunks.push_back(blocksOf(generator.generate(pos)));
    return chunks;
}

// Generates `positions`, in their order, on threads that each take the next index of `order`.
Chunks generateBy(const Generator& generator, const std::vector<ChunkPos>& positions,
                  const std::vector<std::size_t>& order, int threadCount) {
    Chunks chunks(positions.size());
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t k = next++; k < order.size(); k = next++) {
            chunks[order[k]] = blocksOf(generator.generate(positions[order[k]]));
        }
    };
    std::vector<std::thread> threads;
    for (int t = 0; t < threadCount; ++t) threads.emplace_back(work);
    for (std::thread& t : threads) t.join();
    return chunks;
}

std::vector<std::size_t> inOrder(std::size_t count) {
    std::vector<std::size_t> order(count);
    for (std::size_t k = 0; k < count; ++k) order[k] = k;
    return order;
}

// Fails unless the cache of a generator that made these chunks evicted results that they need.
void expectEvictions(const Generator& generator, const std::vector<ChunkPos>& positions) {
    const Generator roomy(build(writeDeep), kTestSeed);
    for (const ChunkPos pos : positions) roomy.generate(pos);
    EXPECT_LT(generator.cacheBytes(), roomy.cacheBytes());
}

void expectSame(const Chunks& a, const Chunks& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) ASSERT_TRUE(a[k] == b[k]) << "chunk " << k << " of the list";
}

class GeneratorTest : public testing::Test {
  protected:
    // The chunks made by one thread in the order of the list.
    const Chunks& expected() {
        if (expected_.empty()) expected_ = generateAll(Generator(build(writeDeep), kTestSeed), positions_);
        return expected_;
    }

    const std::vector<ChunkPos> positions_ = square({-2, -3});

  private:
    Chunks expected_;
};

TEST_F(GeneratorTest, KnowsItsName) {
    EXPECT_EQ(Generator(build(writeFlatStone), 1).name(), "test");
}

TEST_F(GeneratorTest, TheThreadsDoNotMatter) {
    for (const int threads : {1, 2, 4}) {
        SCOPED_TRACE(std::to_string(threads) + " threads");
        const Generator generator(build(writeDeep), kTestSeed);
        const Chunks chunks = generateBy(generator, positions_, inOrder(positions_.size()), threads);
        ASSERT_NO_FATAL_FAILURE(expectSame(chunks, expected()));
    }
}

TEST_F(GeneratorTest, TheOrderOfRequestsDoesNotMatter) {
    std::vector<std::size_t> order = inOrder(positions_.size());
    std::reverse(order.begin(), order.end());
    for (std::uint32_t seed = 0; seed < 3; ++seed) {
        const Generator generator(build(writeDeep), kTestSeed);
        ASSERT_NO_FATAL_FAILURE(
            expectSame(generateBy(generator, positions_, order, 1 + static_cast<int>(seed)), expected()));
        std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    }
}

// With less room than one chunk needs around it, results are computed again and again, but right.
TEST_F(GeneratorTest, TheCacheDoesNotMatter) {
    const std::vector<ChunkPos> few(positions_.begin(), positions_.begin() + 3);
    const Chunks want(expected().begin(), expected().begin() + 3);
    for (const std::size_t capacity : {0u, 1u, 2u, 9u}) {
        SCOPED_TRACE("capacity " + std::to_string(capacity));
        const Generator generator(build(writeDeep), kTestSeed, chunks(capacity));
        ASSERT_NO_FATAL_FAILURE(expectSame(generateBy(generator, few, inOrder(3), 1), want));
        ASSERT_NO_FATAL_FAILURE(expectSame(generateBy(generator, few, inOrder(3), 3), want));
        expectEvictions(generator, few);
    }
}

TEST_F(GeneratorTest, AskingAgainGivesTheSame) {
    const Generator generator(build(writeDeep), kTestSeed, chunks(20));
    for (int round = 0; round < 2; ++round)
        ASSERT_NO_FATAL_FAILURE(expectSame(generateAll(generator, positions_), expected()));
    expectEvictions(generator, positions_);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(blocksOf(generator.generate(positions_[7])), expected()[7]);
}

TEST_F(GeneratorTest, TheCacheKeepsItsMinimum) {
    const Generator least(build(writeDeep), kTestSeed, {.bytes = 0});
    const Generator roomy(build(writeDeep), kTestSeed);
    for (const Generator* generator : {&least, &roomy}) generateAll(*generator, positions_);
    EXPECT_EQ(least.cacheBytes(), roomy.cacheBytes()) << "all that 16 chunks need are fewer than 256";
}

TEST_F(GeneratorTest, TheInstructionSetDoesNotMatter) {
    const std::vector<ChunkPos> few(positions_.begin(), positions_.begin() + 6);
    const Chunks want(expected().begin(), expected().begin() + 6);
    onEachTarget([&] {
        const Generator generator(build(writeDeep), kTestSeed);
        ASSERT_NO_FATAL_FAILURE(expectSame(generateAll(generator, few), want));
    });
}

TEST_F(GeneratorTest, AMovedGeneratorGoesOn) {
    Generator first(build(writeDeep), kTestSeed);
    first.generate(positions_[0]);
    Generator second(std::move(first));
    EXPECT_EQ(blocksOf(second.generate(positions_[1])), expected()[1]);
    second = Generator(build(writeFlatStone), 1);
    EXPECT_EQ(second.generate({0, 0}).block(world::blockIndex(0, 0, 59)), 1);
}

TEST_F(GeneratorTest, SeedsMakeDifferentWorlds) {
    const Chunks other = generateAll(Generator(build(writeDeep), kTestSeed + 1), positions_);
    const Chunks upperHalf =
        generateAll(Generator(build(writeDeep), kTestSeed + (std::uint64_t{1} << 32)), positions_);
    std::size_t differing = 0, differingUpper = 0;
    for (std::size_t k = 0; k < other.size(); ++k) {
        differing += other[k] != expected()[k];
        differingUpper += upperHalf[k] != expected()[k];
    }
    EXPECT_EQ(differing, positions_.size());
    EXPECT_EQ(differingUpper, positions_.size()) << "all 64 bits of the seed count";
}

// Chunks that share neighbors, at a corner of the world where these lie on the other side of it.
TEST_F(GeneratorTest, AtTheCornersOfTheWorld) {
    const std::vector<ChunkPos> corners = {{world::kMinChunk, world::kMinChunk},
                                           {world::kMaxChunk, world::kMaxChunk},
                                           {world::kMinChunk, world::kMaxChunk},
                                           {world::kMaxChunk, world::kMinChunk},
                                           {world::kMaxChunk - 1, 0},
                                           {0, world::kMinChunk + 1}};
    const Chunks want = generateAll(Generator(build(writeDeep), kTestSeed), corners);
    for (int round = 0; round < 5; ++round) {
        const Generator generator(build(writeDeep), kTestSeed);
        ASSERT_NO_FATAL_FAILURE(expectSame(generateBy(generator, corners, inOrder(corners.size()), 4), want));
    }
}

// All threads want all chunks, and each chunk several of its neighbors' passes.
TEST_F(GeneratorTest, ManyThreadsOnNeighborsDoNotLockUp) {
    const Chunks& want = expected();
    for (const std::size_t capacity : {512u, 24u}) {
        for (std::uint32_t round = 0; round < 2; ++round) {
            const Generator generator(build(writeDeep), kTestSeed, chunks(capacity));
            std::vector<std::thread> threads;
            std::atomic<int> wrong = 0;
            for (std::uint32_t t = 0; t < 6; ++t) {
                threads.emplace_back([&, t] {
                    std::vector<std::size_t> order = inOrder(9);
                    std::shuffle(order.begin(), order.end(), std::mt19937(6 * round + t));
                    for (const std::size_t k : order) {
                        wrong += blocksOf(generator.generate(positions_[k])) != want[k];
                    }
                });
            }
            for (std::thread& t : threads) t.join();
            EXPECT_EQ(wrong, 0);
            if (capacity == 24) expectEvictions(generator, {positions_.begin(), positions_.begin() + 9});
        }
    }
}

TEST_F(GeneratorTest, AGeneratorOfOnePass) {
    const Generator generator(build(writeFlatStone), 5, chunks(1));
    const auto flat = [](std::int32_t, std::int32_t, std::int32_t z) { return z < 60 ? 1 : 0; };
    for (const ChunkPos pos : kPlaces) ASSERT_NO_FATAL_FAILURE(expectChunk(generator, pos, flat));
}

// Noise at a block depends on the name of the noise, not on the code before it.
TEST_F(GeneratorTest, SeedsStayWhenCodeMoves) {
    const auto noise = [](Pass& p, const char* name) { return Int(p.perlin2D(name, 7, {1.0f}) * 1000.0f); };
    const Generator one(build([&](GeneratorBuilder& g) {
                            g.pass3D("a", [&](Pass& p) { p.setBlock(Block(noise(p, "hills"))); });
                        }),
                        kTestSeed);
    const Generator two(build([&](GeneratorBuilder& g) {
                            const auto f = g.field<Int>("f");
                            g.pass2D("new", [&](Pass& p) { p.set(f, noise(p, "other")); });
                            g.pass3D("renamed", [&](Pass& p) {
                                p.setBlock(Block(noise(p, "hills") + p.read(f) - p.read(f)));
                            });
                        }),
                        kTestSeed);
    EXPECT_EQ(generateAll(one, positions_), generateAll(two, positions_));
}

// Correlation of two noises of a generator over 64 chunks, from blocks that keep two digits of each.
double correlationOf(const char* nameA, const char* nameB) {
    const auto noise = [](Pass& p, const char* name) {
        return Int(p.perlin2D(name, 5, {1.0f}) * 100.0f) + 128;
    };
    const Generator generator(
        build([&](GeneratorBuilder& g) {
            g.pass3D("both", [&](Pass& p) { p.setBlock(Block(noise(p, nameA) * 256 + noise(p, nameB))); });
        }),
        kTestSeed);
    double product = 0, squareA = 0, squareB = 0;
    for (std::int32_t k = 0; k < 64; ++k) {
        const world::Chunk chunk = generator.generate({k, 3 * k});
        for (int lane = 0; lane < 256; ++lane) {
            const int both = chunk.block(static_cast<world::BlockIndex>(lane));
            const double a = both / 256 - 128, b = both % 256 - 128;
            product += a * b;
            squareA += a * a;
            squareB += b * b;
        }
    }
    return product / std::sqrt(squareA * squareB);
}

TEST_F(GeneratorTest, NoisesOfDifferentNamesHaveNothingInCommon) {
    EXPECT_NEAR(correlationOf("hills", "hills"), 1.0, 1e-9);
    for (const char* name : {"Hills", "hills ", "sllih", "", "mountains"}) {
        EXPECT_NEAR(correlationOf("hills", name), 0.0, 0.1) << name;
    }
}

}  // namespace
}  // namespace terrane::gen
