#include "terrane/world/land_tile.h"

namespace terrane::world {
namespace {

bool isSurface(const BlockType& type) {
    return type.shape != Shape::None && type.shape != Shape::Cross && type.shape != Shape::Hash;
}

bool isEmpty(const Section& section, const BlockRegistry& blocks) {
    return section.isUniform() && !isSurface(blocks.type(section.uniformValue()));
}

}  // namespace

LandTile landTileOf(const Chunk& chunk, const BlockRegistry& blocks) {
    int highest = kSectionsPerChunk - 1;
    while (highest > 0 && isEmpty(chunk.section(highest), blocks)) --highest;
    LandTile tile;
    for (std::size_t k = 0; k < LandTile::kColumns; ++k) {
        for (int z = kSectionSize * (highest + 1); z-- > 0;) {
            const BlockId id = chunk.block(static_cast<BlockIndex>(static_cast<int>(k) | z << 8));
            if (!isSurface(blocks.type(id))) continue;
            tile.height[k] = static_cast<std::uint16_t>(z + 1);
            tile.ground[k] = id;
            break;
        }
    }
    return tile;
}

}  // namespace terrane::world
