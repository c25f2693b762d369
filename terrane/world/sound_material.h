// Materials of blocks for the sounds of steps, placing and breaking.
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

// Names in content files and in names of sounds, by SoundMaterial.
constexpr std::array<std::string_view, 11> kSoundMaterialNames{
    "none", "stone", "wood", "earth", "sand", "grass", "glass", "wool", "metal", "snow", "water"};

}  // namespace terrane::world
