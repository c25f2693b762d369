#include "terrane/sound/sound_player.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <optional>

namespace terrane::sound {
namespace {

constexpr std::size_t kFrames = SoundPlayer::kMemoryRate / 5;

struct Energy {
    double left = 0, right = 0;
    double sum() const { return left + right; }
};

// Without a device: the sound is written into memory.
class SoundPlayerTest : public testing::Test {
  protected:
    static void SetUpTestSuite() { ::setenv("ALSOFT_DRIVERS", "null", 1); }

    void SetUp() override {
        auto player = SoundPlayer::create(sounds(), SoundOutput::Memory);
        if (!player && player.error().code == base::ErrorCode::Unsupported)
            GTEST_SKIP() << player.error().message;
        ASSERT_TRUE(player) << player.error().message;
        player_.emplace(std::move(*player));
        player_->setListener(kEars, 0, 0);
    }
    static SoundSet sounds() {
        Wave tone{22050, {}};
        for (int k = 0; k < 22050; ++k)
            tone.samples.push_back(static_cast<std::int16_t>(16000 * std::sin(k * 0.125)));
        Wave brief{22050, {tone.samples.begin(), tone.samples.begin() + 2205}};
        return {{"tone", {tone}}, {"brief", {brief}}};
    }
    Energy heard(std::size_t frames = kFrames) {
        Energy energy;
        const std::vector<float> samples = player_->render(frames);
        for (std::size_t k = 0; k < samples.size(); k += 2) {
            energy.left += double{samples[k]} * double{samples[k]};
            energy.right += double{samples[k + 1]} * double{samples[k + 1]};
        }
        return energy;
    }
    Energy heardAt(const glm::dvec3& offset) {
        player_->stop();
        (void)player_->render(kFrames);
        player_->play({.name = "tone", .position = kEars + offset});
        return heard();
    }

    // As far out as worlds go, where floats are 256 blocks apart.
    static constexpr glm::dvec3 kEars{2147480000.5, -2147480000.5, 80};
    std::optional<SoundPlayer> player_;
};

TEST_F(SoundPlayerTest, ASoundIsHeard) {
    EXPECT_EQ(heard().sum(), 0);
    player_->play({.name = "tone", .position = {}});
    EXPECT_EQ(player_->playing(), 1);
    EXPECT_GT(heard().sum(), 10);
}

TEST_F(SoundPlayerTest, ASoundEnds) {
    player_->play({.name = "brief", .position = {}});
    EXPECT_GT(heard().sum(), 1);
    EXPECT_EQ(player_->playing(), 0);
    EXPECT_LT(heard().sum(), 1e-3);
}

TEST_F(SoundPlayerTest, UnknownAndSilentSoundsAreNotPlayed) {
    player_->play({.name = "nothing", .position = {}});
    player_->setLoop({.name = "nothing", .position = {}});
    player_->play({.name = "tone", .position = {}, .volume = 0});
    player_->play({.name = "tone", .position = kEars + glm::dvec3(kHearingDistance + 1, 0, 0)});
    EXPECT_EQ(player_->playing(), 0);
}

TEST_F(SoundPlayerTest, DistanceMakesItQuieter) {
    const double near = heardAt({2, 0, 0}).sum(), middle = heardAt({8, 0, 0}).sum(),
                 far = heardAt({32, 0, 0}).sum();
    // Energy falls with the square of the distance.
    EXPECT_NEAR(near / middle, 16, 3);
    EXPECT_NEAR(middle / far, 16, 3);
}

TEST_F(SoundPlayerTest, DirectionIsHeard) {
    // The listener looks along +x: +y is left.
    const Energy left = heardAt({0, 5, 0}), right = heardAt({0, -5, 0}), ahead = heardAt({5, 0, 0});
    EXPECT_GT(left.left, 4 * left.right);
    EXPECT_GT(right.right, 4 * right.left);
    EXPECT_NEAR(ahead.left / ahead.right, 1, 0.05);
    player_->setListener(kEars, 180, 0);
    const Energy turned = heardAt({0, 5, 0});
    EXPECT_GT(turned.right, 4 * turned.left);
}

TEST_F(SoundPlayerTest, ASoundStaysWhereItIs) {
    player_->play({.name = "tone", .position = kEars + glm::dvec3(0, 5, 0)});
    const Energy before = heard();
    player_->setListener(kEars + glm::dvec3(0, 10, 0), 0, 0);
    (void)heard(SoundPlayer::kMemoryRate / 50);
    const Energy after = heard();
    EXPECT_GT(before.left, before.right);
    EXPECT_GT(after.right, after.left);
}

TEST_F(SoundPlayerTest, VolumeIsOfAll) {
    player_->setVolume(0);
    player_->play({.name = "tone", .position = {}});
    (void)heard();
    EXPECT_LT(heard().sum(), 1e-3);
    player_->setVolume(1);
    (void)heard(SoundPlayer::kMemoryRate / 50);
    EXPECT_GT(heard().sum(), 10);
}

TEST_F(SoundPlayerTest, PitchIsHigher) {
    const auto crossings = [&](float pitch) {
        player_->stop();
        (void)player_->render(kFrames);
        player_->play({.name = "tone", .position = {}, .pitch = pitch});
        const std::vector<float> samples = player_->render(kFrames);
        int count = 0;
        for (std::size_t k = 2; k < samples.size(); k += 2) count += (samples[k] > 0) != (samples[k - 2] > 0);
        return count;
    };
    EXPECT_NEAR(static_cast<double>(crossings(2)) / crossings(1), 2, 0.1);
}

TEST_F(SoundPlayerTest, TheQuietestGivesWay) {
    for (int k = 0; k < kMaxSources; ++k)
        player_->play({.name = "tone", .position = {}, .volume = k == 5 ? 0.01f : 0.05f});
    EXPECT_EQ(player_->playing(), kMaxSources);
    (void)heard();
    const double before = heard().sum();
    player_->play({.name = "tone", .position = {}, .volume = 0.005f});
    EXPECT_NEAR(heard().sum() / before, 1, 0.1) << "quieter than all: left out";
    player_->play({.name = "brief", .position = {}, .volume = 1});
    EXPECT_GT(heard().sum(), 1);
    EXPECT_EQ(player_->playing(), kMaxSources - 1) << "it took a place, and has ended";
}

TEST_F(SoundPlayerTest, LoopsGoOnAndFade) {
    player_->setLoop({.name = "brief", .position = {}, .volume = 0.5f});
    player_->update(0.01);
    const double first = heard().sum();
    player_->update(kFadeSeconds);
    (void)heard();
    const double full = heard(SoundPlayer::kMemoryRate * 2).sum();
    EXPECT_GT(full / 10, 10 * first);
    EXPECT_EQ(player_->playing(), 0) << "loops are not counted";
    player_->setLoop({.name = "brief", .position = {}, .volume = 0});
    player_->update(kFadeSeconds / 4);
    (void)heard();
    EXPECT_GT(heard().sum(), 1) << "not at once";
    player_->update(kFadeSeconds);
    (void)heard();
    EXPECT_LT(heard().sum(), 1e-3);
}

TEST_F(SoundPlayerTest, StopSilencesAll) {
    player_->play({.name = "tone", .position = {}});
    player_->setLoop({.name = "brief", .position = {}});
    player_->update(1);
    (void)heard();
    player_->stop();
    (void)heard();
    EXPECT_LT(heard().sum(), 1e-3);
    EXPECT_EQ(player_->playing(), 0);
}

TEST_F(SoundPlayerTest, PlaysOnADevice) {
    player_.reset();
    auto player = SoundPlayer::create(sounds());  // the null device
    ASSERT_TRUE(player) << player.error().message;
    SoundPlayer moved = std::move(*player);
    moved.play({.name = "tone", .position = {}});
    EXPECT_EQ(moved.playing(), 1);
}

}  // namespace
}  // namespace terrane::sound
