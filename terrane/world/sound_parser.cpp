#include "terrane/world/sound_parser.h"

namespace terrane::world {

SoundMaterial readSound(ContentTable& table, Shape shape) {
    const toml::node* value = table.node("sound");
    if (!value && shape == Shape::Liquid) return SoundMaterial::Water;
    if (!value)
        return shape == Shape::Cross || shape == Shape::Hash ? SoundMaterial::Grass : SoundMaterial::Stone;
    const auto found = std::ranges::find(kSoundMaterialNames, value->value_exact<std::string>().value_or(""));
    if (found != kSoundMaterialNames.end())
        return static_cast<SoundMaterial>(found - kSoundMaterialNames.begin());
    table.expected(*value, "sound", fmt::format("one of {}", fmt::join(kSoundMaterialNames, ", ")));
    return SoundMaterial::None;
}

}  // namespace terrane::world
