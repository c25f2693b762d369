#include "terrane/shared/packed_light_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "terrane/shared/hash.h"

namespace terrane::shared {
namespace {

// f of each pair of nibbles.
uint byNibbles(uint a, uint b, const std::function<uint(uint, uint)>& f) {
    uint result = 0;
    for (uint shift = 0; shift < 32; shift += 4) result |= f(a >> shift & 15u, b >> shift & 15u) << shift;
    return result;
}

// All pairs of levels, in every nibble among random ones.
void forManyWords(const std::function<void(uint, uint)>& f) {
    for (uint pair = 0; pair < 256; ++pair) {
        for (uint shift = 0; shift < 32; shift += 4) {
            const uint keep = ~(15u << shift);
            f((mixBits(2 * pair + shift) & keep) | (pair & 15u) << shift,
              (mixBits(3 * pair + shift + 1) & keep) | (pair >> 4) << shift);
        }
    }
}

TEST(PackedLightLevels, MaxIsThatOfEachNibble) {
    forManyWords([](uint a, uint b) {
        ASSERT_EQ(maxLevels(a, b), byNibbles(a, b, [](uint x, uint y) { return std::max(x, y); }));
    });
}

TEST(PackedLightLevels, LessEndsAtZero) {
    forManyWords([](uint a, uint b) {
        const uint low = b & 15u, high = b >> 16 & 15u;
        const uint loss = low * 0x0101u | high * 0x01010000u;
        const uint eachLoss = low * 0x1111u | high * 0x11110000u;
        ASSERT_EQ(lessLevels(a, loss),
                  byNibbles(a, eachLoss, [](uint x, uint y) { return x - std::min(x, y); }));
    });
}

TEST(PackedLightLevels, OpaqueTakesEverything) {
    EXPECT_EQ(lossOfOpacity(0), 1u);
    EXPECT_EQ(lossOfOpacity(11), 12u);
    for (const uint opacity : {14u, 15u}) {
        EXPECT_EQ(lessLevels(0xFFFFFFFFu, lossOfOpacity(opacity) * 0x01010101u), 0u);
    }
}

}  // namespace
}  // namespace terrane::shared
