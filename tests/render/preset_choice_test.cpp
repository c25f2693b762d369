#include "terrane/render/frame/render_options.h"

#include <gtest/gtest.h>

namespace terrane::render {
namespace {

constexpr double kFrames = 60;  // a second

double costOf(std::string_view name) {
    return findPreset(name, false)->relativeCost.value();
}

TEST(PresetChoice, CostsGrowFromPresetToPreset) {
    EXPECT_EQ(costOf("low"), 1);
    EXPECT_LT(costOf("minimal"), costOf("low"));
    EXPECT_LT(costOf("low"), costOf("medium"));
    EXPECT_LT(costOf("medium"), costOf("high"));
    EXPECT_LT(costOf("high"), costOf("ultra"));
    EXPECT_FALSE(findPreset("thesis", false)->relativeCost) << "is for comparison, nobody is given it";
}

TEST(PresetChoice, TheDearestPresetThatHoldsTheTargetIsPicked) {
    for (const char* name : {"minimal", "low", "medium", "high", "ultra"}) {
        const double milliseconds = 0.999 * targetMilliseconds(kFrames) / costOf(name);
        const PresetChoice choice = choosePreset(milliseconds, kFrames);
        EXPECT_EQ(choice.preset->name, name);
        EXPECT_NEAR(choice.framesPerSecond, 1000 / (milliseconds * costOf(name)), 1e-9);
        EXPECT_GE(choice.framesPerSecond, kFrames);
    }
}

TEST(PresetChoice, AStepTooDearIsNotPicked) {
    EXPECT_EQ(choosePreset(1.001 * targetMilliseconds(kFrames), kFrames).preset->name, "minimal");
    EXPECT_EQ(choosePreset(1.001 * targetMilliseconds(kFrames) / costOf("medium"), kFrames).preset->name,
              "low");
    EXPECT_EQ(choosePreset(1.001 * targetMilliseconds(kFrames) / costOf("high"), kFrames).preset->name,
              "medium");
    EXPECT_EQ(choosePreset(1.001 * targetMilliseconds(kFrames) / costOf("ultra"), kFrames).preset->name,
              "high");
}

TEST(PresetChoice, TheCheapestIsForMachinesThatHoldNothing) {
    const PresetChoice choice = choosePreset(125, kFrames);
    EXPECT_EQ(choice.preset->name, "minimal");
    EXPECT_DOUBLE_EQ(choice.framesPerSecond, 8 / costOf("minimal"));
}

TEST(PresetChoice, TheFastestMachineGetsTheDearest) {
    EXPECT_EQ(choosePreset(1e-6, kFrames).preset->name, "ultra");
}

}  // namespace
}  // namespace terrane::render
