// Models of MagicaVoxel (.vox, versions 150 and 200): colored voxels, z up as in our worlds. `terrane import`
// and `terrane export` call it. The functions have no state; any thread may call them.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/formats/block_volume.h"
#include "terrane/world/tint.h"

namespace terrane::formats {

constexpr int kMaxVoxSide = 256;  // of one model; larger boxes are several of them
constexpr std::size_t kMaxVolumeBytes = std::size_t{512} << 20;  // of a .vox file or a schematic

struct VoxImage {
    glm::ivec3 size{0};
    std::array<std::uint32_t, 256> colors{};  // 0xRRGGBBAA; the first is unused
    std::vector<std::uint8_t> cells;          // x + size.x · (y + size.y · z): colors, 0 is empty

    bool operator==(const VoxImage&) const = default;
};

// Reads all models of the scene at their places, in the smallest box that holds them; without a scene the
// first model. Hidden nodes are left out; of animations the first frame is taken; layers, cameras and
// materials are ignored. Returns Damaged if it is no such file, OutOfResources if the box is too large
// (block_volume.h).
[[nodiscard]] base::Result<VoxImage> decodeVox(std::string_view bytes);

// Writes one model, or several in a scene if a side is longer than kMaxVoxSide. decodeVox() gives the same
// image.
[[nodiscard]] std::string encodeVox(const VoxImage& image);

// Returns the palette of files that have none.
[[nodiscard]] std::array<std::uint32_t, 256> defaultVoxColors();

// Returns the opaque cube without tint whose top is nearest to the color 0xRRGGBB, by the distance in Oklab.
[[nodiscard]] world::BlockId nearestCube(std::uint32_t color, const world::BlockRegistry& blocks,
                                         const world::TopColors& tops);

// Converts the image to blocks: colors that the mapping names become its blocks, others the nearest cube.
[[nodiscard]] BlockVolume toBlocks(const VoxImage& image, const BlockMapping& mapping,
                                   const world::BlockRegistry& blocks, const world::TopColors& tops);

// Converts blocks to colors: each block has the color of its top, whatever its state; air is empty. Returns
// an error if there are more than 255 colors.
[[nodiscard]] base::Result<VoxImage> toVox(const BlockVolume& volume, const world::TopColors& tops);

}  // namespace terrane::formats
