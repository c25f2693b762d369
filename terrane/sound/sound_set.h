// Sounds by name, each with some variants.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"

namespace terrane::sound {

// Reads the samples of WAV files.
struct Wave {
    int rate = 0;  // samples a second
    std::vector<std::int16_t> samples;
};

// 48,000 × 60 s × 2 bytes = 5.8 MB.
constexpr std::size_t kMaxWaveSamples = 48000 * 60;

// Reads a file of one channel with 16 bits a sample, at 8,000 to 48,000 a second. Errors begin with `name`.
base::Result<Wave> parseWave(std::string_view bytes, std::string_view name);

using SoundSet = std::map<std::string, std::vector<Wave>, std::less<>>;

// Returns the sounds that tools/synthesize_sounds.py made for the program: "stone_step" has the variants
// stone_step_1.wav, stone_step_2.wav…; empty in a build without sounds.
base::Result<SoundSet> builtInSounds();

}  // namespace terrane::sound
