// Finds out whether the system can play sounds.
#pragma once

#include <filesystem>

namespace terrane::sound {

// False if it surely cannot: opening a device would then make libraries of the system print errors. A sound
// card is a file in `devices`; a sound server has a socket in the user's runtime folder or is named by a
// variable, as are the drivers of OpenAL.
bool hasSoundCard(const std::filesystem::path& devices = "/dev/snd");

}  // namespace terrane::sound
