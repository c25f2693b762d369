#include "terrane/sound/sound_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace terrane::sound {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string number(std::uint32_t value, int bytes) {
    std::string text;
    for (int k = 0; k < bytes; ++k) text += static_cast<char>(value >> (8 * k) & 255);
    return text;
}

std::string chunk(const std::string& kind, const std::string& content) {
    return kind + number(static_cast<std::uint32_t>(content.size()), 4) + content +
           std::string(content.size() % 2, '\0');
}

std::string format(int channels, std::uint32_t rate, int bits) {
    return chunk("fmt ", number(1, 2) + number(static_cast<std::uint32_t>(channels), 2) + number(rate, 4) +
                             number(0, 4) + number(0, 2) + number(static_cast<std::uint32_t>(bits), 2));
}

std::string file(const std::string& chunks) {
    return "RIFF" + number(static_cast<std::uint32_t>(4 + chunks.size()), 4) + "WAVE" + chunks;
}

std::string errorOf(std::string_view bytes) {
    const auto wave = parseWave(bytes, "a.wav");
    return wave ? "" : wave.error().message;
}

const std::string kSamples = chunk("data", number(1, 2) + number(0xFFFF, 2) + number(0x8000, 2));

TEST(WaveFile, SamplesAreRead) {
    const Wave wave = parseWave(file(format(1, 22050, 16) + kSamples), "a.wav").value();
    EXPECT_EQ(wave.rate, 22050);
    EXPECT_THAT(wave.samples, ElementsAre(1, -1, -32768));
}

TEST(WaveFile, OtherChunksAreSkipped) {
    const std::string bytes = file(chunk("LIST", "odd") + format(1, 44100, 16) + kSamples);
    EXPECT_EQ(parseWave(bytes, "a.wav").value().samples.size(), 3u);
}

TEST(WaveFile, WhatCannotBePlayedIsRefused) {
    EXPECT_EQ(errorOf("RIFX"), "a.wav: not a WAV file");
    EXPECT_EQ(errorOf(file("")), "a.wav: cut short");
    EXPECT_THAT(errorOf(file(format(2, 22050, 16) + kSamples)), HasSubstr("one channel of 16 bits"));
    EXPECT_THAT(errorOf(file(format(1, 22050, 8) + kSamples)), HasSubstr("one channel of 16 bits"));
    EXPECT_THAT(errorOf(file(format(1, 100, 16) + kSamples)), HasSubstr("8000 to 48000 Hz"));
    EXPECT_THAT(errorOf(file(format(1, 22050, 16) + chunk("data", ""))), HasSubstr("got 0"));
}

TEST(WaveFile, FilesThatEndEarlyAreRefused) {
    const std::string whole = file(format(1, 22050, 16) + kSamples);
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_NE(errorOf(std::string_view(whole).substr(0, size)), "") << size;
}

}  // namespace
}  // namespace terrane::sound
