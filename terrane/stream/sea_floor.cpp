#include "terrane/stream/sea_floor.h"

namespace terrane::stream {
namespace {

using world::BlockId;
using world::BlockIndex;

// The height of the sections, in blocks, above which all is air.
int heightOf(const world::Chunk& tile) {
    int number = world::kSectionsPerChunk;
    while (number > 0 && tile.section(number - 1) == world::Section(world::kAir)) --number;
    return number * world::kSectionSize;
}

struct Column {
    int surface = 0;  // its highest block
    int floor = 0;    // the highest block below the liquid; none: -1
};

// Surface and floor of the liquid that is open to the sky; equal if there is none.
Column liquidAt(const world::Chunk& tile, const world::BlockRegistry& blocks, int x, int y, int height) {
    const auto block = [&](int z) { return tile.block(world::blockIndex(x, y, z)); };
    int z = height - 1;
    while (z >= 0 && block(z) == world::kAir) --z;
    Column column{z, z};
    if (z < 0) return column;
    const BlockId top = block(z);
    if (blocks.type(top).shape != world::Shape::Liquid) return column;
    while (column.floor >= 0 && block(column.floor) == top) --column.floor;
    return column;
}

}  // namespace

void raiseDeepFloor(world::Chunk& tile, const world::BlockRegistry& blocks) {
    const int height = heightOf(tile);
    BlockId ground = world::kAir;  // of the first such column
    for (int y = 0; y < world::kChunkSize; ++y) {
        for (int x = 0; x < world::kChunkSize; ++x) {
            const Column column = liquidAt(tile, blocks, x, y, height);
            if (column.floor < 0 || column.surface - column.floor <= kDeepestSeen) continue;
            const BlockId floor = tile.block(world::blockIndex(x, y, column.floor));
            if (!blocks.type(floor).opaqueCube) continue;
            if (ground == world::kAir) ground = floor;
            for (int z = column.floor; z <= column.surface - kDeepestSeen; ++z)
                tile.setBlock(world::blockIndex(x, y, z), ground);
        }
    }
}

}  // namespace terrane::stream
