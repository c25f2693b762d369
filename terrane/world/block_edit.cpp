#include "terrane/world/block_edit.h"

#include <utility>

namespace terrane::world {
namespace {

// Plants stand on full blocks, and on their own kind where they grow in columns (cactus).
bool givesGround(const BlockRegistry& registry, BlockId below, BlockId plant) {
    return below != kAir && (registry.type(below).opaqueCube || below == plant);
}

// Blocks above `pos` in the same chunk fall until one stands.
void dropPlants(Chunk& chunk, const BlockRegistry& registry, BlockPos pos, std::vector<BlockEdit>& edits) {
    for (BlockPos above{pos.x, pos.y, pos.z + 1}; above.z < kChunkHeight; ++above.z) {
        const BlockIndex index = blockIndex(above);
        const BlockId plant = chunk.block(index);
        if (plant == kAir || !registry.type(plant).needsGround ||
            givesGround(registry, chunk.block(blockIndex({above.x, above.y, above.z - 1})), plant)) {
            return;
        }
        chunk.setBlock(index, kAir);
        edits.push_back({above, plant, kAir});
    }
}

}  // namespace

// The friend of World that changes blocks: the only way to a chunk that can be written.
struct BlockWriter {
    World& world;
    const BlockRegistry& registry;
    BlockPos pos;
    std::vector<BlockEdit>& edits;

    void operator()(const SetBlock& change) const {
        const BlockId before = world.block(pos);
        const bool isBare = change.id != kAir && registry.type(change.id).needsGround &&
                            !givesGround(registry, world.block({pos.x, pos.y, pos.z - 1}), change.id);
        if (before == change.id || isBare) return;
        Chunk* chunk = world.findWritable(pos);
        if (!chunk) return;
        chunk->setBlock(blockIndex(pos), change.id);
        edits.push_back({pos, before, change.id});
        const std::size_t stages = registry.type(change.id).growth.size();
        if (stages > 0) chunk->setBlockState(blockIndex(pos), static_cast<std::uint16_t>(stages));
        dropPlants(*chunk, registry, pos, edits);
    }

    void operator()(const SetState& change) const {
        if (Chunk* chunk = world.findWritable(pos)) {
            chunk->setBlockState(blockIndex(pos), change.value);
            addDataEdit(*chunk);
        }
    }

    void operator()(const SetEntityData& change) const {
        if (Chunk* chunk = world.findWritable(pos)) {
            chunk->setBlockEntityData(blockIndex(pos), change.data);
            addDataEdit(*chunk);
        }
    }

    void addDataEdit(const Chunk& chunk) const {
        const BlockId id = chunk.block(blockIndex(pos));
        edits.push_back({pos, id, id});
    }
};

void applyChange(World& world, const BlockRegistry& registry, BlockPos pos, const BlockChange& change,
                 std::vector<BlockEdit>& edits) {
    std::visit(BlockWriter{world, registry, pos, edits}, change);
}

}  // namespace terrane::world
