#include "apps/terrane/window/preset_measurement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace terrane::app {
namespace {

using Frame = PresetMeasurement::Frame;

// Seconds until a preset is known, and which one. `frame`: of each time since the start.
template <class FrameAt>
std::pair<double, std::string_view> measure(FrameAt frameAt) {
    PresetMeasurement measurement;
    for (double time = 0; time < 100;) {
        const Frame frame = frameAt(time);
        time += frame.seconds;
        if (const auto choice = measurement.add(frame)) return {time, choice->preset->name};
    }
    return {100, ""};
}

TEST(PresetMeasurement, OneSecondOfTheCompleteViewIsEnough) {
    const auto [seconds, name] = measure([](double) { return Frame{0.01, 0.01, true}; });
    EXPECT_NEAR(seconds, PresetMeasurement::kSeconds, 0.02);
    EXPECT_EQ(name, "ultra");
}

TEST(PresetMeasurement, AnIncompleteViewMayOnlySayLow) {
    EXPECT_NEAR(measure([](double) { return Frame{0.1, 100, false}; }).first, 1, 0.11);
    // Cheap frames at first, dear ones when all chunks are there.
    const auto [seconds, name] = measure([](double time) {
        return time < 3.5 ? Frame{0.01, 0.01, false} : Frame{0.02, 20, true};
    });
    EXPECT_NEAR(seconds, 4.5, 0.05);
    EXPECT_EQ(name, "low");
}

TEST(PresetMeasurement, ItDoesNotWaitForEver) {
    const auto [seconds, name] = measure([](double) { return Frame{0.01, 0.01, false}; });
    EXPECT_NEAR(seconds, PresetMeasurement::kMostSeconds, 1.1);
    EXPECT_EQ(name, "ultra");
}

TEST(PresetMeasurement, SingleSlowFramesDoNotCount) {
    int frames = 0;
    const auto measured = measure([&](double) { return Frame{0.01, frames++ % 3 == 0 ? 500 : 0.01, true}; });
    EXPECT_EQ(measured.second, "ultra");
}

TEST(PresetMeasurement, WithoutAFramesGpuTimeItsSecondsCount) {
    EXPECT_EQ(measure([](double) { return Frame{0.1, 0, true}; }).second, "low");
    EXPECT_EQ(measure([](double) { return Frame{0.0001, 0, true}; }).second, "ultra");
}

TEST(PresetMeasurement, TheMessageNamesPresetFramesAndDevice) {
    const render::PresetChoice choice{&render::presets()[1], 74.3};
    EXPECT_THAT(messageOf(choice, "llvmpipe (LLVM 15.0.6, 256 bits)"),
                testing::StartsWith("graphics: medium, for 74 frames/s on llvmpipe (measured; "));
    EXPECT_THAT(messageOf(choice, "NVIDIA GeForce RTX 3080/PCIe/SSE2"),
                testing::HasSubstr("on NVIDIA GeForce RTX 3080 (measured"));
    EXPECT_THAT(messageOf(choice, "Apple M1"), testing::HasSubstr("on Apple M1 (measured"));
}

}  // namespace
}  // namespace terrane::app
