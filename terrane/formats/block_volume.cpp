#include "terrane/formats/block_volume.h"

#include <string>
#include <unordered_map>

namespace terrane::formats {

base::Result<void> checkVolumeSize(std::int64_t x, std::int64_t y, std::int64_t z) {
    if (x < 1 || y < 1 || z < 1)
        return base::fail(base::ErrorCode::Damaged, "a box of {}×{}×{} blocks is empty", x, y, z);
    const bool isTooLarge = x > kMaxVolumeBlocks || y > kMaxVolumeBlocks / x || z > kMaxVolumeBlocks / x / y;
    if (isTooLarge)
        return base::fail(base::ErrorCode::OutOfResources,
                          "a box of {}×{}×{} blocks is larger than {} blocks", x, y, z, kMaxVolumeBlocks);
    return {};
}

BlockVolume toBlocks(const NamedVolume& volume, const BlockMapping& mapping, ImportCounts& counts) {
    BlockVolume result{volume.size, {}, volume.cells};
    for (const NamedState& state : volume.palette) result.palette.push_back(mapping.blockOf(state));
    std::vector<std::uint64_t> uses(volume.palette.size());
    for (const std::uint16_t cell : volume.cells) ++uses[cell];
    addUses(volume.palette, uses, mapping, counts);
    return result;
}

NamedVolume toNames(const BlockVolume& volume, const BlockMapping& mapping) {
    NamedVolume result{volume.size, {}, volume.cells};
    for (const BlockAndState block : volume.palette) result.palette.push_back(mapping.nameOf(block));
    return result;
}

base::Result<world::Structure> toStructure(const BlockVolume& volume, const world::BlockRegistry& blocks) {
    world::Structure structure;
    structure.size = volume.size;
    if (structure.blockCount() > world::kMaxStructureBlocks || volume.size.z > world::kMostLayers)
        return base::fail(base::ErrorCode::OutOfResources,
                          "{}×{}×{} blocks are more than a structure has: {}, and {} in height",
                          volume.size.x, volume.size.y, volume.size.z, world::kMaxStructureBlocks,
                          world::kMostLayers);
    // The structure's palette has distinct entries in the order in which cells first use them.
    std::vector<std::uint32_t> entryOf(volume.palette.size(), UINT32_MAX);
    std::unordered_map<std::uint32_t, std::uint32_t> known;  // by id and state
    for (const std::uint16_t cell : volume.cells) {
        std::uint32_t& entry = entryOf[cell];
        if (entry == UINT32_MAX) {
            const BlockAndState block = volume.palette[cell];
            const auto key = static_cast<std::uint32_t>(block.id << 16 | block.state);
            const auto [found, isNew] = known.try_emplace(key, static_cast<std::uint32_t>(known.size()));
            if (isNew) structure.palette.push_back({blocks.type(block.id).name, block.state});
            entry = found->second;
        }
        structure.cells.push_back(entry);
    }
    return structure;
}

}  // namespace terrane::formats
