#include "terrane/shared/hash.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

namespace terrane::shared {
namespace {

// Generated worlds depend on these values: computed apart from this code, with integers of unlimited size.
TEST(Hash, KnownAnswers) {
    EXPECT_EQ(mixBits(0u), 0u);
    EXPECT_EQ(mixBits(1u), 0x688990c0u);
    EXPECT_EQ(mixBits(0x80000000u), 0xcc4b4124u);
    EXPECT_EQ(mixBits(0xffffffffu), 0x6768824au);

    EXPECT_EQ(hash2(0u, 0u, 0u), 0u);
    EXPECT_EQ(hash2(1u, 0u, 0u), 0x72ec61aeu);
    EXPECT_EQ(hash2(0u, 1u, 0u), 0xb9c14937u);
    EXPECT_EQ(hash2(0xffffffffu, 0xffffffffu, 42u), 0xf61828d9u);
    EXPECT_EQ(hash2(0x80000000u, 0x7fffffffu, 7u), 0x82eab4abu);

    EXPECT_EQ(hash3(0u, 0u, 0u, 0u), 0u);
    EXPECT_EQ(hash3(0u, 0u, 1u, 0u), 0x79fd5fb2u);
    EXPECT_EQ(hash3(1u, 2u, 3u, 4u), 0xc393d4adu);
    EXPECT_EQ(hash3(0xffffffffu, 0x80000000u, 255u, 0xdeadbeefu), 0xab70aefau);
}

// Flipping any bit of any input must flip each bit of the result in about half of the cases.
TEST(Hash, Avalanche) {
    constexpr int kSamples = 4096;
    std::mt19937 random(1);
    for (uint input = 0; input < 4; ++input)
        for (uint bit = 0; bit < 32; ++bit) {
            std::vector<int> flips(32, 0);
            for (int i = 0; i < kSamples; ++i) {
                std::array<uint, 4> in;
                for (uint& value : in) value = static_cast<uint>(random());
                const uint before = hash3(in[0], in[1], in[2], in[3]);
                in[input] ^= 1u << bit;
                const uint changed = before ^ hash3(in[0], in[1], in[2], in[3]);
                for (uint out = 0; out < 32; ++out) flips[out] += static_cast<int>(changed >> out & 1u);
            }
            // Standard deviation is 0.5 / sqrt(4096) = 0.8 %; 5 % is six of them.
            for (uint out = 0; out < 32; ++out)
                EXPECT_NEAR(flips[out] / double{kSamples}, 0.5, 0.05)
                    << "input " << input << " bit " << bit << " on " << out;
        }
}

// Positions around the origin: no more equal results than chance gives (n² / 2 pairs out
// of 2^32 results: one half on average for 65,536 positions, 8 for 262,144).
TEST(Hash, NeighborsDiffer) {
    const auto distinct = [](std::vector<uint> results) {
        std::sort(results.begin(), results.end());
        return std::unique(results.begin(), results.end()) - results.begin();
    };
    std::vector<uint> plane, cube;
    for (int y = -128; y < 128; ++y)
        for (int x = -128; x < 128; ++x)
            plane.push_back(hash2(static_cast<uint>(x), static_cast<uint>(y), 12345u));
    for (int z = -32; z < 32; ++z)
        for (int y = -32; y < 32; ++y)
            for (int x = -32; x < 32; ++x)
                cube.push_back(hash3(static_cast<uint>(x), static_cast<uint>(y), static_cast<uint>(z), 7u));
    EXPECT_GE(distinct(plane), 65536 - 4);
    EXPECT_GE(distinct(cube), 262144 - 24);
}

// Shares of a range, as random choices take them.
TEST(Hash, ValuesAreEven) {
    std::vector<int> counts(16, 0);
    for (uint z = 0; z < 16; ++z)
        for (uint y = 0; y < 64; ++y)
            for (uint x = 0; x < 64; ++x) ++counts[hash3(x, y, z, 7u) >> 28];
    for (const int count : counts) EXPECT_NEAR(count, 4096, 320);  // five standard deviations
}

}  // namespace
}  // namespace terrane::shared
