// Imports a box of blocks, a schematic or a MagicaVoxel model, into a world or a structure file.
#pragma once

#include <cstdint>
#include <filesystem>

#include "terrane/base/result.h"
#include "terrane/io/import_world.h"
#include "terrane/world/coords.h"

namespace terrane::io {

enum class VolumeFormat : std::uint8_t { Schematic, Vox };

struct VolumeOptions {
    // Limit: leaves room for the size of a box, so that its corners do not overflow.
    static constexpr std::int32_t kFarthest = 2'000'000'000;

    VolumeFormat format = VolumeFormat::Schematic;
    world::BlockPos corner;  // where the lowest block goes; coordinates up to kFarthest
    bool skipsAir = false;   // air of the source leaves the world as it is
};

// Sets seed and generator in `options` to the world's.
[[nodiscard]] base::Result<ImportReport> importVolume(ImportOptions& options, const VolumeOptions& volume,
                                                      const Progress& progress = {});
// The same into a structure file. Uses the content of options.world.
[[nodiscard]] base::Result<ImportReport> importStructure(const ImportOptions& options, VolumeFormat format,
                                                         const std::filesystem::path& output);

}  // namespace terrane::io
