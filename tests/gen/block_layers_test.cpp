#include "terrane/gen/cpu/block_layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "tests/gen/gen_fixture.h"
#include "tests/gen/pass_runner.h"

namespace terrane::gen {
namespace {

using LayerBlocks = std::array<std::uint16_t, kTileLanes>;

// Layers written in random pieces, bottom up or top down, and what each of them has.
class RandomLayers {
  public:
    RandomLayers(std::uint32_t seed, world::Heights heights)
        : random_(seed), expected_(static_cast<std::size_t>(heights.layers())), heights_(heights) {}

    void write(BlockLayers& layers, const BlockLayers& before) {
        const bool isDown = below(2) == 0;
        for (int done = 0; done < heights_.layers();) {
            const int count = std::min(1 + below(below(4) == 0 ? 100 : 9), heights_.layers() - done);
            const int z = isDown ? heights_.top - done - count : heights_.bottom + done;
            writePiece(layers, before, z, count);
            done += count;
        }
    }

    void expect(const BlockLayers& layers) const {
        for (int z = heights_.bottom; z < heights_.top; ++z) {
            const LayerBlocks& want = at(z);
            ASSERT_TRUE(std::equal(want.begin(), want.end(), layers.layer(z))) << z;
            const auto [low, high] = std::minmax_element(want.begin(), want.end());
            ASSERT_EQ(layers.range(z), (BlockRange{*low, *high})) << z;
        }
        for (int number = heights_.firstSection(); number < heights_.endSection(); ++number) {
            const std::uint16_t first = at(number * 16)[0];
            bool isOne = true;
            for (int z = number * 16; z < number * 16 + 16; ++z)
                for (const std::uint16_t block : at(z)) isOne = isOne && block == first;
            ASSERT_EQ(layers.uniformBlock(number).has_value(), isOne) << number;
            if (isOne) {
                ASSERT_EQ(layers.uniformBlock(number), first);
            } else {
                ASSERT_EQ(layers.section(number)[0], first);
                ASSERT_EQ(layers.section(number).back(), at(number * 16 + 15).back());
            }
        }
    }

    // By looking at each layer.
    void expectRanges(const BlockLayers& layers) {
        for (int k = 0; k < 200; ++k) {
            const int first = heights_.bottom + below(heights_.layers());
            const int last = std::min(first + below(k % 2 == 0 ? 10 : 400), heights_.top - 1);
            const auto found = layers.range(first, last);
            if (!found) {
                ASSERT_GT(last - first, 5 * 16 - 1);
                continue;
            }
            BlockRange all = layers.range(first);
            bool isAlike = true;
            for (int z = first; z <= last; ++z) {
                const BlockRange one = layers.range(z);
                isAlike = isAlike && one == layers.range(first);
                all = {std::min(all.low, one.low), std::max(all.high, one.high)};
            }
            ASSERT_EQ(found->blocks, all);
            ASSERT_EQ(found->isAlike, isAlike);
        }
    }

  private:
    int below(int count) { return static_cast<int>(random_() % static_cast<std::uint32_t>(count)); }
    LayerBlocks& at(int z) { return expected_[static_cast<std::size_t>(z - heights_.bottom)]; }
    const LayerBlocks& at(int z) const { return expected_[static_cast<std::size_t>(z - heights_.bottom)]; }

    void writePiece(BlockLayers& layers, const BlockLayers& before, int z, int count) {
        const int way = below(4);
        const auto block = static_cast<std::uint16_t>(below(3) * 21845);
        alignas(64) std::array<Bits, kTileLanes> values;
        for (Bits& value : values) value = way == 2 && below(5) == 0 ? random_() : 0xABC0000u + block;
        if (way == 0) {
            layers.fill(z, count, block);
        } else if (way == 1) {
            layers.copy(before, z, count);
        } else {
            layers.write(z, values.data());
            if (way == 2) layers.repeat(z, count);
            for (int k = 1; k < count && way == 3; ++k) layers.write(z + k, values.data());
        }
        for (int k = z; k < z + count; ++k) {
            for (std::size_t lane = 0; lane < kTileLanes; ++lane)
                at(k)[lane] = way == 1   ? before.layer(k)[lane]
                              : way == 0 ? block
                                         : static_cast<std::uint16_t>(values[lane]);
        }
    }

    std::mt19937 random_;
    std::vector<LayerBlocks> expected_;
    world::Heights heights_;
};

TEST(BlockLayers, HaveWhatWasWritten) {
    for (const world::Heights heights : kSomeHeights) {
        SCOPED_TRACE(world::describe(heights));
        BlockLayers before(heights), layers(heights);
        before.fill(heights.bottom, heights.layers(), 7);
        for (std::uint32_t seed = 0; seed < kRandomCases / 6; ++seed) {
            RandomLayers random(seed, heights);
            layers.clear();
            random.write(layers, before);
            ASSERT_NO_FATAL_FAILURE(random.expect(layers)) << seed;
            ASSERT_NO_FATAL_FAILURE(random.expectRanges(layers)) << seed;
            if (seed % 3 == 0) layers.compact();
            ASSERT_NO_FATAL_FAILURE(random.expect(layers)) << seed;
            std::swap(before, layers);
        }
    }
}

TEST(BlockLayers, LayersOfOneBlockNeedNoMemory) {
    const world::Heights tallest = {world::kLowestBottom, world::kHighestTop};
    BlockLayers layers(tallest);
    const std::size_t empty = layers.memoryBytes();
    EXPECT_LT(empty, 16'000u);
    layers.fill(-2048, 2000, 1);
    layers.fill(-48, 3, 2);
    layers.fill(-45, 29, 2);
    layers.fill(-16, 2064, 0);
    EXPECT_LT(layers.memoryBytes(), empty + 2000);
    alignas(64) std::array<Bits, kTileLanes> values{};
    values[3] = 1;
    layers.clear();
    layers.fill(-2048, 4000, 1);
    for (int z = 1952; z < 1968; ++z) layers.write(z, values.data());
    layers.fill(1968, 80, 0);
    EXPECT_LT(layers.memoryBytes(), empty + 2000 + 9000);
    values[3] = 0;
    layers.clear();
    layers.fill(-2048, 4080, 0);
    for (int z = 2032; z < 2048; ++z) layers.write(z, values.data());
    EXPECT_EQ(layers.uniformBlock(127), 0);
    EXPECT_GT(layers.memoryBytes(), empty + 8000);
    layers.compact();
    EXPECT_LT(layers.memoryBytes(), empty + 2000);
    EXPECT_EQ(layers.uniformBlock(127), 0);
}

TEST(BlockLayers, AnEditedLayerKeepsItsOtherBlocks) {
    BlockLayers layers({-16, 16});
    layers.fill(-16, 32, 5);
    layers.edit(-3)[17] = 9;
    EXPECT_EQ(layers.layer(-3)[16], 5);
    EXPECT_EQ(layers.layer(-3)[17], 9);
    EXPECT_EQ(layers.layer(-4)[17], 5);
    EXPECT_EQ(layers.range(-3), (BlockRange{0, UINT16_MAX}));
    EXPECT_EQ(layers.range(-4), (BlockRange{5, 5}));
    EXPECT_EQ(layers.uniformBlock(-1), std::nullopt);
    EXPECT_EQ(layers.uniformBlock(0), 5);
}

}  // namespace
}  // namespace terrane::gen
