// Imports a box of blocks, a schematic or a MagicaVoxel model, into a world or a structure file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/io/import_world.h"
#include "terrane/world/coords.h"

namespace terrane::io {

enum class VolumeFormat : std::uint8_t { Schematic, Vox };

struct VolumeOptions {
    VolumeFormat format = VolumeFormat::Schematic;
    world::BlockPos corner;  // where the lowest block goes
    bool skipsAir = false;   // air of the source leaves the world as it is
};

// Sets seed and generator in `options` to the world's. Fails if the box reaches past the end of the world, or
// lies wholly above or below it; otherwise layers above and below are counted.
[[nodiscard]] base::Result<ImportReport> importVolume(ImportOptions& options, const VolumeOptions& volume,
                                                      const Progress& progress = {});
struct ImportedStructure {
    ImportReport report;
    std::vector<std::byte> bytes;  // of a structure file
};
// The same into a structure. Uses the content of options.world.
[[nodiscard]] base::Result<ImportedStructure> importStructure(const ImportOptions& options,
                                                              VolumeFormat format);

}  // namespace terrane::io
