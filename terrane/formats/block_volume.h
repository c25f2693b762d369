// A box of blocks that is read from a file or written to one. It is used by the readers and writers of this
// module and by `terrane import` and `terrane export`. All are plain values; any thread may use them.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/formats/block_mapping.h"
#include "terrane/formats/minecraft_chunk.h"
#include "terrane/world/changes/structure.h"

namespace terrane::formats {

// 2^25 blocks × 2 bytes = 64 MiB: a box of 256 blocks in height and 362 in each direction.
constexpr std::int64_t kMaxVolumeBlocks = std::int64_t{1} << 25;

// z is up. A block's index is x + size.x · (y + size.y · z).
template <class T>
struct Volume {
    glm::ivec3 size{0};                // in blocks, each at least 1
    std::vector<T> palette;            // at most 65,536
    std::vector<std::uint16_t> cells;  // indices into the palette
};
using BlockVolume = Volume<BlockAndState>;
using NamedVolume = Volume<NamedState>;

// Returns an error if a side is below 1 or there are more than kMaxVolumeBlocks.
[[nodiscard]] base::Result<void> checkVolumeSize(std::int64_t x, std::int64_t y, std::int64_t z);

// Maps the names to blocks, and adds the blocks to `counts`, as toChunk() does.
[[nodiscard]] BlockVolume toBlocks(const NamedVolume& volume, const BlockMapping& mapping,
                                   ImportCounts& counts);
[[nodiscard]] NamedVolume toNames(const BlockVolume& volume, const BlockMapping& mapping);

// Returns OutOfResources if it has more blocks than a structure (world::kMaxStructureBlocks) or is higher
// than a world.
[[nodiscard]] base::Result<world::Structure> toStructure(const BlockVolume& volume,
                                                         const world::BlockRegistry& blocks);

}  // namespace terrane::formats
