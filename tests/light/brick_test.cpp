#include "terrane/light/brick.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace terrane::light {
namespace {

TEST(Brick, UsualUniformBricksAreShared) {
    for (const int value : {0x0000, 0x1111, 0x7777, 0xFFFF, 0xF000}) {
        const Brick* brick = sharedUniformBrick(static_cast<LightValue>(value));
        ASSERT_NE(brick, nullptr) << value;
        EXPECT_TRUE(
            std::all_of(brick->values.begin(), brick->values.end(), [&](int v) { return v == value; }));
    }
    EXPECT_EQ(sharedUniformBrick(0xE000), nullptr);
    EXPECT_EQ(sharedUniformBrick(0x1110), nullptr);
}

TEST(BrickPool, MakesUniformBricksOfAnyValue) {
    BrickPool pool;
    const BrickView view = pool.uniform(0x0DDF);
    EXPECT_TRUE(view.isUniform);
    EXPECT_TRUE(
        std::all_of(view.values, view.values + world::kBlocksPerSection, [](int v) { return v == 0x0DDF; }));
    EXPECT_EQ(pool.uniform(0).values, sharedUniformBrick(0)->values.data());
}

TEST(BrickPool, HandsBricksOutAgainAfterReset) {
    BrickPool pool;
    Brick* first = pool.acquire();
    EXPECT_NE(pool.acquire(), first);
    pool.reset();
    Brick* const again[] = {pool.acquire(), pool.acquire()};
    EXPECT_TRUE(again[0] == first || again[1] == first);
}

TEST(BrickPool, KeepsNothingOfWhatItReleased) {
    BrickPool pool;
    Brick* first = pool.acquire();
    const auto released = pool.release();
    ASSERT_EQ(released.size(), 1u);
    EXPECT_EQ(released[0].get(), first);
    EXPECT_NE(pool.acquire(), first);
}

TEST(Brick, PacksAndUnpacks) {
    BrickPool pool;
    Brick* brick = pool.acquire();
    for (std::size_t k = 0; k < brick->values.size(); ++k) brick->values[k] = static_cast<LightValue>(k % 7);
    const LightBrick packed = packBrick({brick->values.data(), nullptr, false});
    EXPECT_EQ(packed.get(4095), 0);  // 4095 = 7·585
    EXPECT_EQ(packed.get(13), 6);
    const BrickView unpacked = pool.unpack(packed);
    EXPECT_TRUE(std::equal(brick->values.begin(), brick->values.end(), unpacked.values));
    EXPECT_TRUE(packBrick(pool.uniform(9)).isUniform());
}

}  // namespace
}  // namespace terrane::light
