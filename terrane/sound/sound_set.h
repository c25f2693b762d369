// Sounds by name, each with some variants.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "terrane/sound/wave_file.h"

namespace terrane::sound {

using SoundSet = std::map<std::string, std::vector<Wave>, std::less<>>;

// The sounds that tools/synthesize_sounds.py made for the program: "stone_step" has the variants
// stone_step_1.wav, stone_step_2.wav…; empty in a build without sounds.
base::Result<SoundSet> builtInSounds();

}  // namespace terrane::sound
