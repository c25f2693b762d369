// Packs on the disk: folders and zip files. Any thread.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "terrane/pack/pack.h"

namespace terrane::pack {

// A folder with pack.toml in it, or a zip file with pack.toml at its top or in its only folder. Errors name
// the file.
[[nodiscard]] base::Result<Pack> readPack(const std::filesystem::path& path);

// The folder or zip file of a pack that is named by its path (with a slash, or ending in ".zip"), or by its
// name, which is looked for in `folders` as NAME and NAME.zip. NotFound says where it was looked for.
[[nodiscard]] base::Result<std::filesystem::path> findPack(std::string_view nameOrPath,
                                                           std::span<const std::filesystem::path> folders);

// The packs of a folder, by name; those that cannot be read are left out. None where there is no folder.
// Looks at 1,000 entries at most.
std::vector<std::filesystem::path> packsIn(const std::filesystem::path& folder);

}  // namespace terrane::pack
