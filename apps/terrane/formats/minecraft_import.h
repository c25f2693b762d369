// terrane import minecraft: imports chunks of region files into a world. Called by import_command.cpp.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/terrane/formats/import_world.h"
#include "terrane/base/result.h"
#include "terrane/formats/region_file.h"

namespace terrane::app {

// Finds the region files of a Minecraft world. Called by minecraft_import.cpp on the command's thread.
struct RegionSource {
    std::filesystem::path path;
    formats::RegionPos pos;
};

// The region files that have chunks, ordered by z, then x. `source` is a world's folder, a folder of region
// files, or one such file; `dimension` is "overworld", "nether" or "end", for a world's folder. If a world
// has chunks in the folders of several versions, those of the newest. Files that cannot be read count as
// having chunks. NotFound if there are none.
[[nodiscard]] base::Result<std::vector<RegionSource>> regionsOf(const std::filesystem::path& source,
                                                                const std::string& dimension);

// Minecraft's coordinates of a chunk, and the chunk with a number, 0 to kRegionChunks - 1, in a region.
struct RegionChunk {
    std::int64_t x = 0, z = 0;
};
[[nodiscard]] RegionChunk chunkOfRegion(formats::RegionPos region, int number);

// Reads a chunk that Minecraft keeps in a file of its own beside the region.
[[nodiscard]] base::Result<std::string> readExternalChunk(const RegionSource& region, int number);

// Chunks with edits in the world are kept, so a stopped run can continue. Chunks that cannot be read are
// skipped, counted and logged; options.exitCode is then 1.
[[nodiscard]] base::Result<void> importMinecraft(ImportOptions& options);

}  // namespace terrane::app
