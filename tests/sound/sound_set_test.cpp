#include "terrane/sound/sound_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "terrane/world/blocks/block_type.h"

namespace terrane::sound {
namespace {

constexpr std::size_t kMostBytes = 2 << 20;  // of all sounds, in the program
constexpr double kFull = 32767;

class BuiltInSounds : public testing::Test {
  protected:
    void SetUp() override {
        if (sounds_.empty()) GTEST_SKIP() << "this build has no sounds";
    }
    template <class Check>
    void forEach(Check check) const {
        for (const auto& [name, variants] : sounds_)
            for (const Wave& wave : variants) check(name, wave);
    }

    const SoundSet sounds_ = builtInSounds().value();
};

double peakOf(const Wave& wave) {
    double peak = 0;
    for (const std::int16_t sample : wave.samples) peak = std::max(peak, std::abs(sample / kFull));
    return peak;
}

TEST_F(BuiltInSounds, EveryMaterialHasItsSounds) {
    using world::SoundMaterial;
    for (const std::string_view material : world::kSoundMaterialNames) {
        if (material == "none" || material == "water") continue;
        for (const auto& [action, count] : {std::pair("step", 3u), {"place", 2u}, {"break", 2u}}) {
            const auto found = sounds_.find(std::string(material) + "_" + action);
            ASSERT_NE(found, sounds_.end()) << material << " " << action;
            EXPECT_EQ(found->second.size(), count) << material << " " << action;
        }
    }
    for (const char* name :
         {"water_splash", "water_swim", "water_place", "water_loop", "wind_loop", "ui_click"})
        EXPECT_TRUE(sounds_.contains(name)) << name;
}

TEST_F(BuiltInSounds, FitIntoTheProgram) {
    std::size_t bytes = 0;
    forEach([&](const std::string&, const Wave& wave) { bytes += 2 * wave.samples.size(); });
    EXPECT_LT(bytes, kMostBytes);
}

TEST_F(BuiltInSounds, AreLoudButNotClipped) {
    forEach([](const std::string& name, const Wave& wave) {
        EXPECT_GT(peakOf(wave), 0.3) << name;
        EXPECT_LT(peakOf(wave), 0.85) << name;
    });
}

TEST_F(BuiltInSounds, HaveNoOffset) {
    forEach([](const std::string& name, const Wave& wave) {
        const double sum = std::accumulate(wave.samples.begin(), wave.samples.end(), 0.0);
        EXPECT_LT(std::abs(sum / kFull / static_cast<double>(wave.samples.size())), 0.002) << name;
    });
}

// Single sounds begin and end in silence. In a loop the step from the end to the beginning is no larger than
// others.
TEST_F(BuiltInSounds, EndWithoutAClick) {
    forEach([](const std::string& name, const Wave& wave) {
        const auto& samples = wave.samples;
        const auto stepAt = [&](std::size_t k) {
            return std::abs(samples[k] - samples[(k + 1) % samples.size()]) / kFull;
        };
        if (name.ends_with("_loop")) {
            double largest = 0;
            for (std::size_t k = 0; k + 1 < samples.size(); ++k) largest = std::max(largest, stepAt(k));
            EXPECT_LE(stepAt(samples.size() - 1), largest) << name;
        } else {
            EXPECT_LT(std::abs(samples.front()) / kFull, 0.02) << name;
            EXPECT_LT(std::abs(samples.back()) / kFull, 0.02) << name;
        }
    });
}

TEST_F(BuiltInSounds, VariantsDiffer) {
    for (const auto& [name, variants] : sounds_)
        for (std::size_t k = 1; k < variants.size(); ++k)
            EXPECT_NE(variants[k].samples, variants[0].samples) << name;
}

}  // namespace
}  // namespace terrane::sound
