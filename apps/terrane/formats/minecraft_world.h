// The region files of a world of Minecraft. Called by minecraft_import.h on the command's thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/formats/region_file.h"

namespace terrane::app {

struct RegionSource {
    std::filesystem::path path;
    formats::RegionPos pos;
};

// In the order of z and x. `source` is a world's folder, a folder of region files, or one such file;
// `dimension`, "overworld", "nether" or "end", of a world's folder. NotFound where there is no region file.
[[nodiscard]] base::Result<std::vector<RegionSource>> regionsOf(const std::filesystem::path& source,
                                                                const std::string& dimension);

// Reads a chunk in a file of its own beside its region.
[[nodiscard]] base::Result<std::string> readExternalChunk(const RegionSource& region, int number);

}  // namespace terrane::app
