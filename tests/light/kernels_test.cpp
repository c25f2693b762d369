#include "terrane/light/kernels_internal.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "tests/light/test_area.h"

namespace terrane::light {
namespace {

TEST(LightKernels, SunlightLosesTheOpacityOfEachColumn) {
    BrickPool pool;
    Brick &opacity = *pool.acquire(), &light = *pool.acquire();
    opacity.values.fill(0);
    opacity.values[7 + 256 * 9] = 0x4444;
    DaylightColumns columns;
    columns.fill(kFullDaylight);
    columns[8] = 3 << 12;
    propagateSunlight(opacity.values.data(), sharedUniformBrick(0x1111)->values.data(), columns,
                      light.values.data());
    EXPECT_EQ(light.values[7 + 256 * 10], 0xF111);
    EXPECT_EQ(light.values[7 + 256 * 9], 0xB111);
    EXPECT_EQ(light.values[7], 0xB111);
    EXPECT_EQ(light.values[8], 0x3111);
    EXPECT_EQ(columns[7], 11 << 12);
    EXPECT_EQ(columns[8], 3 << 12);
    EXPECT_EQ(columns[255], kFullDaylight);
}

TEST(LightKernels, ReplaceDecreasedChoosesByLevel) {
    BrickPool pool;
    Brick &decreased = *pool.acquire(), &light = *pool.acquire();
    decreased.values.fill(0);
    decreased.values[100] = 0x0F0A;  // red and blue
    const LightValue* source = sharedUniformBrick(0x2222)->values.data();
    const LightValue* before = sharedUniformBrick(0x7777)->values.data();
    replaceDecreased(decreased.values.data(), source, before, light.values.data());
    EXPECT_EQ(light.values[99], 0x7777);
    EXPECT_EQ(light.values[100], 0x7272);
}

// Runs light on each instruction set of the machine, the widest vectors and the narrowest.
TEST(LightKernels, GiveTheSameOnEveryInstructionSet) {
    const TestArea area(2, 2, caves(40));
    const std::vector<ChunkLight> expected = area.lights();
    int count = 0;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        EXPECT_TRUE(area.lights() == expected) << hwy::TargetName(target);
        ++count;
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    EXPECT_GT(count, 0);
}

}  // namespace
}  // namespace terrane::light
