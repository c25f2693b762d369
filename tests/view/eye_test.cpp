// The eye adapts to what is in view: to rooms without light and to nights, and to the color of lamps.
#include "terrane/view/eye.h"

#include <gtest/gtest.h>

#include "terrane/render/frame/tone.h"
#include "tests/game/session_fixture.h"

namespace terrane::view {
namespace {

using world::BlockPos;

constexpr float kScreen = 16.0f / 9;
constexpr float kNoon = 0.5f, kMidnight = 0.0f;
// In the middle of a room of 7³ blocks under the ground, and above it.
constexpr glm::dvec3 kInRoom{8.5, 8.5, 40.5}, kOutside{8.5, 8.5, game::kGroundHeight + 2.6};

class EyeTest : public game::SessionTest {
  protected:
    EyeTest() {
        for (int x = 5; x < 12; ++x)
            for (int y = 5; y < 12; ++y)
                for (int z = 37; z < 44; ++z) set({x, y, z}, "air");
        settle();
    }

    void set(BlockPos pos, const char* name) {
        const world::PlacedBlock placed{pos, {contentBlock(name), 0, nullptr}};
        session_.setBlocks({&placed, 1});
    }

    static render::FrameInput frame(glm::dvec3 position, float timeDay) {
        return {{position, 20, -15}, world::environmentAt(timeDay)};
    }
    glm::vec3 exposure(glm::dvec3 position, float timeDay) {
        return exposureFor(seenLight(session_, frame(position, timeDay), kScreen));
    }
};

// As bright as the screen shows a card of 18 % in light of that luminance.
float shownCard(float light, glm::vec3 exposure) {
    return render::displayColor(0.18f * light * exposure).y;
}

TEST_F(EyeTest, TellsBlocksThatItSeesThrough) {
    const auto at = [&](glm::dvec3 position) { return blockAtCamera(session_, {.position = position}); };
    const double ground = game::kGroundHeight;
    EXPECT_EQ(at({2.5, 2.5, ground - 3}), "inside stone");
    EXPECT_EQ(at({2.5, 2.5, ground}), "at a face of stone");
    EXPECT_EQ(at({2.5, 2.5, ground + 0.05}), "at a face of stone");
    EXPECT_EQ(at({2.5, 2.5, ground + 0.2}), std::nullopt);
    EXPECT_EQ(at(kInRoom), std::nullopt);
    EXPECT_EQ(at({5.05, 8.5, 40.5}), "at a face of stone");
    set({2, 2, game::kGroundHeight}, "poppy");
    EXPECT_EQ(at({2.5, 2.5, ground + 0.5}), std::nullopt) << "one walks through flowers";
}

TEST_F(EyeTest, ByDayNothingChanges) {
    for (const float time : {0.35f, kNoon, 0.65f}) EXPECT_EQ(exposure(kOutside, time), glm::vec3(1)) << time;
}

TEST_F(EyeTest, AGreyCardIsReadableInTheDarkAndDarkerThanInTheSun) {
    const SeenLight dark = seenLight(session_, frame(kInRoom, kNoon), kScreen);
    const SeenLight sun = seenLight(session_, frame(kOutside, kNoon), kScreen);
    EXPECT_NEAR(dark.luminance, 0.006f, 1e-5f);
    const float inRoom = shownCard(dark.luminance, exposureFor(dark)), in8Bits = 255 * inRoom;
    EXPECT_GT(in8Bits, 15);
    EXPECT_LT(255 * shownCard(dark.luminance, glm::vec3(1)), 5) << "without adaptation";
    EXPECT_LT(inRoom, shownCard(sun.luminance, exposureFor(sun)) / 2);
}

TEST_F(EyeTest, NightsGetBrighterAndStayNights) {
    const SeenLight night = seenLight(session_, frame(kOutside, kMidnight), kScreen);
    const SeenLight noon = seenLight(session_, frame(kOutside, kNoon), kScreen);
    const glm::vec3 adapted = exposureFor(night);
    EXPECT_GT(adapted.y, 1.2f);
    EXPECT_LT(night.luminance * adapted.y, noon.luminance / 2);
}

TEST_F(EyeTest, DarkerIsNeverBrighter) {
    float shown = 0;
    for (float light = 0.001f; light < 4; light *= 1.1f) {
        const float now = light * exposureFor({light, glm::vec3(1)}).y;
        EXPECT_GT(now, shown) << light;
        shown = now;
    }
}

TEST_F(EyeTest, ColoredLampsGetWhiterWithoutGettingBrighter) {
    set({8, 8, 37}, "lamp_red");
    settle();
    const SeenLight seen = seenLight(session_, frame(kInRoom, kMidnight), kScreen);
    EXPECT_GT(seen.color.x, 2 * seen.color.z);
    const glm::vec3 white = exposureFor({seen.luminance, glm::vec3(1)}), adapted = exposureFor(seen);
    EXPECT_LT(adapted.x, white.x);
    EXPECT_GT(adapted.z, white.z);
    const glm::vec3 weights(0.2126f, 0.7152f, 0.0722f);
    EXPECT_NEAR(glm::dot(weights, adapted * seen.color), white.y, 1e-4f);
    EXPECT_GT(adapted.x * seen.color.x, adapted.z * seen.color.z) << "red stays red";
}

TEST_F(EyeTest, WhatGlowsIsBright) {
    for (int x = 5; x < 12; ++x)
        for (int y = 5; y < 12; ++y) set({x, y, 44}, "crystal_rock");
    settle();
    render::FrameInput up = frame(kInRoom, kNoon);
    const SeenLight aside = seenLight(session_, up, kScreen);
    up.camera.pitch = 70;
    EXPECT_GT(seenLight(session_, up, kScreen).luminance, 2 * aside.luminance);
}

TEST_F(EyeTest, AdaptsInTimeWhateverTheFrames) {
    const auto after = [&](int frames) {
        Eye eye;
        EXPECT_EQ(eye.look(session_, frame(kOutside, kNoon), kScreen, 0), glm::vec3(1))
            << "the first frame is adapted";
        glm::vec3 exposure(1);
        for (int k = 0; k < frames; ++k)
            exposure = eye.look(session_, frame(kInRoom, kNoon), kScreen, 1.5 / frames);
        return exposure.x;
    };
    const float target = exposure(kInRoom, kNoon).x, share = 1 - std::exp(-1.0f);
    EXPECT_NEAR(after(1), 1 + share * (target - 1), 1e-3f);
    EXPECT_NEAR(after(15), after(1), 1e-3f);
    EXPECT_NEAR(after(150), after(15), 0.08f * target) << "the eye looks ten times a second";
}

TEST_F(EyeTest, DaylightBlindsForLessTimeThanTheDark) {
    Eye toDark, toLight;
    toDark.look(session_, frame(kOutside, kNoon), kScreen, 0);
    const float dark = toLight.look(session_, frame(kInRoom, kNoon), kScreen, 0).x;
    const float left = toLight.look(session_, frame(kOutside, kNoon), kScreen, 0.5).x - 1;
    const float missing = dark - toDark.look(session_, frame(kInRoom, kNoon), kScreen, 0.5).x;
    EXPECT_LT(left, missing / 2);
}

}  // namespace
}  // namespace terrane::view
