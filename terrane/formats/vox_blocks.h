// Converts colors of .vox files to blocks and back. Called by `terrane import` and `terrane export`. Plain
// functions; any thread.
#pragma once

#include <string>

#include "terrane/base/result.h"
#include "terrane/formats/block_volume.h"
#include "terrane/formats/vox_file.h"
#include "terrane/world/top_colors.h"

namespace terrane::formats {

// The opaque cube without tint whose top is nearest to the color 0xRRGGBB, by the distance in Oklab.
[[nodiscard]] world::BlockId nearestCube(std::uint32_t color, const world::BlockRegistry& blocks,
                                         const world::TopColors& tops);

// Colors that the mapping names become its blocks, others the nearest cube.
[[nodiscard]] BlockVolume toBlocks(const VoxImage& image, const BlockMapping& mapping,
                                   const world::BlockRegistry& blocks, const world::TopColors& tops);

// Each block has the color of its top, whatever its state; air is empty. An error if there are more than 255
// colors.
[[nodiscard]] base::Result<VoxImage> toVox(const BlockVolume& volume, const world::TopColors& tops);

}  // namespace terrane::formats
