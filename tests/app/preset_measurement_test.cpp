#include "apps/terrane/window/settings/preset_measurement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace terrane::app {
namespace {

using Frame = PresetMeasurement::Frame;

struct Measured {
    double seconds = 0;  // until the preset was known
    std::string_view preset;
    double framesPerSecond = 0;
};

// `frameOf` returns the frame at a time since the start with a preset.
template <class FrameOf>
Measured measure(FrameOf frameOf) {
    PresetMeasurement measurement(60);
    for (double time = 0; time < 100;) {
        const Frame frame = frameOf(time, measurement.preset().name);
        time += frame.seconds;
        if (const auto choice = measurement.add(frame))
            return {time, choice->preset->name, choice->framesPerSecond};
    }
    return {};
}

TEST(PresetMeasurement, ASecondOfLowAndOneOfTheExpectedPresetAreEnough) {
    const Measured measured = measure([](double, std::string_view preset) {
        return Frame{0.01, preset == "low" ? 0.01 : 5, true};
    });
    EXPECT_NEAR(measured.seconds, 2 * PresetMeasurement::kSeconds, 0.03);
    EXPECT_EQ(measured.preset, "ultra");
    EXPECT_DOUBLE_EQ(measured.framesPerSecond, 200);
}

TEST(PresetMeasurement, APresetDearerThanExpectedGivesWay) {
    const auto measureWith = [](double high, double medium) {
        return measure([=](double, std::string_view preset) {
            const double milliseconds = preset == "low"      ? 1
                                        : preset == "medium" ? medium
                                        : preset == "high"   ? high
                                                             : 30;
            return Frame{0.01, milliseconds, true};
        });
    };
    EXPECT_EQ(measureWith(12.5, 10).preset, "high");
    EXPECT_DOUBLE_EQ(measureWith(12.5, 10).framesPerSecond, 80);
    EXPECT_EQ(measureWith(25, 10).preset, "medium");
    EXPECT_EQ(measureWith(25, 20).preset, "low");
    EXPECT_DOUBLE_EQ(measureWith(25, 20).framesPerSecond, 1000) << "low's own";
}

TEST(PresetMeasurement, AnIncompleteViewMayOnlySayThatLowIsTooDear) {
    EXPECT_NEAR(measure([](double, auto) { return Frame{0.1, 100, false}; }).seconds, 2, 0.21);
    // Cheap frames at first, expensive ones when all chunks are loaded.
    const Measured measured = measure([](double time, auto) {
        return time < 3.5 ? Frame{0.01, 0.01, false} : Frame{0.02, 20, true};
    });
    EXPECT_NEAR(measured.seconds, 5.5, 0.05);
    EXPECT_EQ(measured.preset, "minimal");
    EXPECT_DOUBLE_EQ(measured.framesPerSecond, 50);
}

// Low is too dear at once, the cheapest preset only when the view is complete.
TEST(PresetMeasurement, TheCheapestPresetIsMeasuredInACompleteView) {
    const Measured measured = measure([](double time, std::string_view preset) {
        return Frame{0.02, preset == "low" || time > 4 ? 40.0 : 5.0, time > 4};
    });
    EXPECT_EQ(measured.preset, "minimal");
    EXPECT_DOUBLE_EQ(measured.framesPerSecond, 25);
}

TEST(PresetMeasurement, ItDoesNotWaitForEver) {
    const Measured measured = measure([](double, auto) { return Frame{0.01, 10, false}; });
    EXPECT_NEAR(measured.seconds, PresetMeasurement::kMostSeconds, 1.1);
    EXPECT_EQ(measured.preset, "low");
    const Measured restless = measure([](double time, auto) {
        return Frame{0.1, 10, static_cast<int>(time * 2) % 2 == 0};
    });
    EXPECT_LT(restless.seconds, 3) << "a view that was complete once counts as such";
}

TEST(PresetMeasurement, SingleSlowFramesDoNotCount) {
    int frames = 0;
    const Measured measured = measure([&](double, auto) {
        return Frame{0.01, frames++ % 3 == 0 ? 500 : 0.01, true};
    });
    EXPECT_EQ(measured.preset, "ultra");
}

TEST(PresetMeasurement, WithoutAFramesGpuTimeItsSecondsCount) {
    EXPECT_EQ(measure([](double, auto) { return Frame{0.1, 0, true}; }).preset, "minimal");
    EXPECT_EQ(measure([](double, auto) { return Frame{0.0001, 0, true}; }).preset, "ultra");
}

TEST(PresetMeasurement, TheMessageNamesPresetFramesAndDevice) {
    const render::PresetChoice choice{render::findPreset("medium", false), 74.3};
    EXPECT_THAT(messageOf(choice, "llvmpipe (LLVM 15.0.6, 256 bits)"),
                testing::StartsWith("graphics: medium, for 74 frames/s on llvmpipe (measured; "));
    EXPECT_THAT(messageOf(choice, "NVIDIA GeForce RTX 3080/PCIe/SSE2"),
                testing::HasSubstr("on NVIDIA GeForce RTX 3080 (measured"));
    EXPECT_THAT(messageOf(choice, "Apple M1"), testing::HasSubstr("on Apple M1 (measured"));
}

}  // namespace
}  // namespace terrane::app
