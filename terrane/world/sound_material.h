// What a block sounds like when one walks on it, places or breaks it.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace terrane::world {

enum class SoundMaterial : std::uint8_t {
    None,
    Stone,
    Wood,
    Earth,
    Sand,
    Grass,
    Glass,
    Wool,
    Metal,
    Snow,
    Water
};

// In the content file and in the names of sounds, by SoundMaterial.
constexpr std::array<std::string_view, 11> kSoundMaterialNames{
    "none", "stone", "wood", "earth", "sand", "grass", "glass", "wool", "metal", "snow", "water"};

}  // namespace terrane::world
