// Packs by name or path, from the packs folder of the user. Any thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "terrane/pack/content.h"

namespace terrane::pack {

// Where packs are looked for by name: $XDG_DATA_HOME/terrane/packs. None where no variable names a home.
std::vector<std::filesystem::path> packFolders();

// Packs by names and paths. One that is named twice is read once.
[[nodiscard]] base::Result<std::vector<Pack>> readPacks(const std::vector<std::string>& namesOrPaths);

// Adds the packs `names` that are not among `packs`. One that is not in the packs folder is left out, with a
// line in the log: a world without it shows its blocks as missing.
[[nodiscard]] base::Result<void> addPacks(std::vector<Pack>& packs, const std::vector<std::string>& names);

// Adds what the packs require and nobody named, from the packs folder.
[[nodiscard]] base::Result<void> addRequired(std::vector<Pack>& packs);

// The same packs as their files are now.
[[nodiscard]] base::Result<Content> loadAgain(const Content& content);

}  // namespace terrane::pack
