#include "terrane/sound/sound_card.h"

#include <cstdlib>
#include <string>
#include <system_error>

namespace terrane::sound {
namespace {

namespace fs = std::filesystem;

bool isSet(const char* variable) {
    const char* value = std::getenv(variable);
    return value && *value;
}

bool hasServer() {
    std::error_code ignored;
    if (!isSet("XDG_RUNTIME_DIR")) return false;
    const fs::path folder = std::getenv("XDG_RUNTIME_DIR");
    return fs::exists(folder / "pulse" / "native", ignored) || fs::exists(folder / "pipewire-0", ignored);
}

// pcmC0D0p: device 0 of card 0, playback.
bool isPlayback(const fs::path& file) {
    const std::string name = file.filename().string();
    return name.starts_with("pcm") && name.ends_with('p');
}

}  // namespace

bool hasSoundCard(const fs::path& devices) {
    if (isSet("ALSOFT_DRIVERS") || isSet("PULSE_SERVER") || hasServer()) return true;
    std::error_code error;
    for (fs::directory_iterator file(devices, error), end; !error && file != end; file.increment(error))
        if (isPlayback(file->path())) return true;
    return false;
}

}  // namespace terrane::sound
