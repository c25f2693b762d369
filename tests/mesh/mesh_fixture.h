// Chunks made of block functions, or of a few blocks placed by hand, for the tests of the mesher.
#pragma once

#include <array>
#include <functional>
#include <string_view>
#include <vector>

#include "terrane/mesh/chunk_mesher.h"
#include "terrane/shared/hash.h"
#include "tests/mesh/test_blocks.h"

namespace terrane::mesh {

// The block at x, y relative to the middle chunk (-16…31), and z.
using BlockSource = std::function<world::BlockId(int x, int y, int z)>;

inline world::Chunk makeChunk(int originX, int originY, const BlockSource& source,
                              world::Heights heights = {}) {
    world::Chunk chunk(heights);
    std::array<world::BlockId, world::kBlocksPerSection> values;
    for (int number = heights.firstSection(); number < heights.endSection(); ++number) {
        for (int i = 0; i < world::kBlocksPerSection; ++i) {
            const int x = originX + (i & 15), y = originY + ((i >> 4) & 15), z = number * 16 + (i >> 8);
            values[static_cast<std::size_t>(i)] = source(x, y, z);
        }
        chunk.setSection(number, world::Section::fromValues(values));
    }
    return chunk;
}

// Calls use(index) for each block of a chunk.
template <class Use>
void forEachBlock(const world::Chunk& chunk, Use use) {
    const world::BlockIndex end = world::blockIndex(0, 0, chunk.heights().top);
    for (world::BlockIndex i = world::blockIndex(0, 0, chunk.heights().bottom); i < end; ++i) use(i);
}

// A chunk and the four beside it.
struct Area {
    explicit Area(const BlockSource& source, world::Heights heights = {})
        : center(makeChunk(0, 0, source, heights)),
          beside{makeChunk(-16, 0, source, heights), makeChunk(16, 0, source, heights),
                 makeChunk(0, -16, source, heights), makeChunk(0, 16, source, heights)} {}

    // Data for one block in eight, whatever it is.
    void addBlockState(unsigned seed) {
        addBlockState(center, seed);
        for (unsigned side = 0; side < 4; ++side) addBlockState(beside[side], seed + side);
    }

    static void addBlockState(world::Chunk& chunk, unsigned seed) {
        forEachBlock(chunk, [&](world::BlockIndex i) {
            const unsigned hash = shared::hash2(static_cast<unsigned>(i), 0, seed);
            if (hash % 8 != 0 || (hash >> 8) % 16 < seed % 16) return;
            const unsigned state = hash >> 24 & 1 ? hash / 8 % 5 : hash >> 12 & 255;
            chunk.setBlockState(i, static_cast<std::uint16_t>(state));
        });
    }

    // Each block of a liquid one form or another, as no flow would leave it; half of them still.
    void addFlow(unsigned seed) {
        unsigned number = seed;
        for (world::Chunk* chunk : {&center, &beside[0], &beside[1], &beside[2], &beside[3]}) {
            ++number;
            forEachBlock(*chunk, [&](world::BlockIndex index) {
                const unsigned hash = shared::hash2(static_cast<unsigned>(index), number, seed);
                if (testBlocks().type(chunk->block(index)).shape != world::Shape::Liquid || hash % 2 == 0)
                    return;
                const unsigned unsettled = hash >> 20 & 1;
                chunk->setBlockState(index, static_cast<std::uint16_t>((hash >> 4) % 12 | unsettled << 15));
            });
        }
    }

    MeshInput input(const MeshOptions& options = {}) const {
        return {&center, {&beside[0], &beside[1], &beside[2], &beside[3]}, &testBlocks(), options};
    }

    world::Chunk center;
    std::array<world::Chunk, 4> beside;
};

inline ChunkMesh meshOf(const Area& area, const MeshOptions& options = {}) {
    MeshScratch scratch;
    return meshChunk(area.input(options), scratch);
}

// Blocks placed by hand in air; coordinates as in BlockSource.
struct Placed {
    int x, y, z;
    std::string_view name;
};

inline Area placed(const std::vector<Placed>& blocks) {
    return Area([&](int x, int y, int z) {
        for (const Placed& block : blocks) {
            if (block.x == x && block.y == y && block.z == z) return idOf(block.name);
        }
        return world::kAir;
    });
}

}  // namespace terrane::mesh
