// Imports chunks of Minecraft's region files into a world.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/formats/region_file.h"
#include "terrane/io/import_world.h"
#include "terrane/world/coords.h"

namespace terrane::io {

// A region file of a Minecraft world.
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

struct MinecraftOptions {
    std::string dimension = "overworld";
    std::optional<world::ChunkArea> area;  // x0, z0, x1, z1 in Minecraft's chunks; none: all
    world::ChunkPos at;                    // of Minecraft's origin
    int shift = 0;                         // blocks added to heights
};

// Chunks with edits in the world are kept, so a stopped run can continue. Chunks that cannot be read are
// skipped, counted in the report and logged. Unless `options` name heights, a new world gets those that hold
// all sections of the chunks, which are read for that first. Sets seed, generator and heights in `options` to
// the world's.
[[nodiscard]] base::Result<ImportReport> importMinecraft(ImportOptions& options,
                                                         const MinecraftOptions& minecraft,
                                                         const Progress& progress = {});

}  // namespace terrane::io
