// Packs on the disk: folders and zip files. Any thread.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "terrane/pack/pack.h"

namespace terrane::pack {

// Reads a folder with pack.toml in it, or a zip file with pack.toml at its top or in a folder at its top.
// Errors name the file.
[[nodiscard]] base::Result<Pack> readPack(const std::filesystem::path& path);

// Finds the folder or zip file of a pack by its path (with a slash, or ending in ".zip"), or by its name, as
// NAME or NAME.zip in `folders`. NotFound names the folders that were searched.
[[nodiscard]] base::Result<std::filesystem::path> findPack(std::string_view nameOrPath,
                                                           std::span<const std::filesystem::path> folders);

// The packs of a folder, sorted: zip files, and folders with pack.toml. None is opened. Empty if there is no
// folder. Looks at 1,000 entries at most.
std::vector<std::filesystem::path> packsIn(const std::filesystem::path& folder);

}  // namespace terrane::pack
