#include "terrane/world/block_update.h"

namespace terrane::world {
namespace {

// Plants stand on full blocks, and on their own kind where they grow in columns (cactus).
bool givesGround(const BlockRegistry& registry, BlockId below, BlockId plant) {
    return below != kAir && (registry.type(below).opaqueCube || below == plant);
}

}  // namespace

std::vector<BlockUpdate> updateBlock(World& world, const BlockRegistry& registry, BlockPos pos, BlockId id) {
    std::vector<BlockUpdate> updates;
    const BlockId before = world.block(pos);
    const bool isBare = id != kAir && registry.type(id).needsGround &&
                        !givesGround(registry, world.block({pos.x, pos.y, pos.z - 1}), id);
    if (before == id || isBare || !world.setBlock(pos, id)) return updates;
    updates.push_back({pos, before});
    const std::size_t stages = registry.type(id).growth.size();
    if (stages > 0) world.setSmallData(pos, static_cast<std::uint16_t>(stages));
    for (BlockPos above{pos.x, pos.y, pos.z + 1}; above.z < kChunkHeight; ++above.z) {
        const BlockId plant = world.block(above);
        const BlockId below = world.block({above.x, above.y, above.z - 1});
        if (plant == kAir || !registry.type(plant).needsGround || givesGround(registry, below, plant)) break;
        world.setBlock(above, kAir);
        updates.push_back({above, plant});
    }
    return updates;
}

}  // namespace terrane::world
