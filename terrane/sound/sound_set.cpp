#include "terrane/sound/sound_set.h"

#include "terrane/base/embedded.h"

namespace terrane::embedded {
std::span<const base::EmbeddedFile> sounds();
}  // namespace terrane::embedded

namespace terrane::sound {

base::Result<SoundSet> builtInSounds() {
    SoundSet sounds;
    for (const base::EmbeddedFile& file : embedded::sounds()) {
        auto wave = TERRANE_TRY(parseWave(file.data, file.path));
        sounds[std::string(file.path.substr(0, file.path.rfind('_')))].push_back(std::move(wave));
    }
    return sounds;
}

}  // namespace terrane::sound
