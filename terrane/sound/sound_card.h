// Whether the system has something to play sounds on.
#pragma once

#include <filesystem>

namespace terrane::sound {

// False where it surely has nothing: to open a device then makes libraries of the system write lines of
// errors. A sound card is a file in `devices`; a server of sounds listens in the user's runtime folder, or is
// named by a variable, as are the drivers that OpenAL is to use.
bool hasSoundCard(const std::filesystem::path& devices = "/dev/snd");

}  // namespace terrane::sound
