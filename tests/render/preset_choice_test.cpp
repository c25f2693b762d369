#include "terrane/render/frame/render_options.h"

#include <gtest/gtest.h>

namespace terrane::render {
namespace {

double costOf(std::string_view name) {
    return findPreset(name, false)->relativeCost.value();
}

TEST(PresetChoice, CostsGrowFromPresetToPreset) {
    EXPECT_EQ(costOf("low"), 1);
    EXPECT_LT(costOf("low"), costOf("medium"));
    EXPECT_LT(costOf("medium"), costOf("high"));
    EXPECT_LT(costOf("high"), costOf("ultra"));
    EXPECT_FALSE(findPreset("thesis", false)->relativeCost) << "is for comparison, nobody is given it";
}

TEST(PresetChoice, TheDearestPresetThatHoldsTheTargetIsPicked) {
    for (const char* name : {"low", "medium", "high", "ultra"}) {
        const double milliseconds = 0.999 * kTargetMilliseconds / costOf(name);
        const PresetChoice choice = choosePreset(milliseconds);
        EXPECT_EQ(choice.preset->name, name);
        EXPECT_NEAR(choice.framesPerSecond, 1000 / (milliseconds * costOf(name)), 1e-9);
        EXPECT_GE(choice.framesPerSecond, kTargetFramesPerSecond);
    }
}

TEST(PresetChoice, AStepTooDearIsNotPicked) {
    EXPECT_EQ(choosePreset(1.001 * kTargetMilliseconds / costOf("medium")).preset->name, "low");
    EXPECT_EQ(choosePreset(1.001 * kTargetMilliseconds / costOf("high")).preset->name, "medium");
    EXPECT_EQ(choosePreset(1.001 * kTargetMilliseconds / costOf("ultra")).preset->name, "high");
}

TEST(PresetChoice, LowIsForMachinesThatHoldNothing) {
    const PresetChoice choice = choosePreset(125);
    EXPECT_EQ(choice.preset->name, "low");
    EXPECT_DOUBLE_EQ(choice.framesPerSecond, 8);
}

TEST(PresetChoice, TheFastestMachineGetsTheDearest) {
    EXPECT_EQ(choosePreset(1e-6).preset->name, "ultra");
}

}  // namespace
}  // namespace terrane::render
