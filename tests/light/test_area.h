// Small areas of chunks filled block by block, for the tests of light. x and y count from the area's corner.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "terrane/light/chunk_light.h"
#include "terrane/light/light_area.h"
#include "terrane/shared/hash.h"
#include "tests/world/content_blocks.h"

namespace terrane::light {

inline const LightTable& contentTable() {
    static const LightTable table(contentBlocks());
    return table;
}

struct TestArea {
    using Source = std::function<world::BlockId(int x, int y, int z)>;

    TestArea(int sizeX, int sizeY, const Source& source, world::Heights itsHeights = {})
        : chunksX(sizeX), chunksY(sizeY), heights(itsHeights) {
        for (int cy = 0; cy < chunksY; ++cy) {
            for (int cx = 0; cx < chunksX; ++cx) chunks.push_back(makeChunk(cx, cy, source, heights));
        }
    }

    int width() const { return chunksX * world::kChunkSize; }
    int height() const { return chunksY * world::kChunkSize; }
    std::size_t index(int x, int y, int z) const {
        return static_cast<std::size_t>(x + width() * (y + height() * (z - heights.bottom)));
    }
    std::size_t chunkIndex(int x, int y) const {
        return static_cast<std::size_t>(x / world::kChunkSize + chunksX * (y / world::kChunkSize));
    }
    const world::BlockType& type(int x, int y, int z) const {
        return contentBlocks().type(chunks[chunkIndex(x, y)].block(world::blockIndex(x & 15, y & 15, z)));
    }
    void set(int x, int y, int z, world::BlockId id) {
        chunks[chunkIndex(x, y)].setBlock(world::blockIndex(x & 15, y & 15, z), id);
    }
    LightArea view() const {
        LightArea area{chunksX, chunksY, {}};
        for (const world::Chunk& chunk : chunks) area.chunks.push_back(&chunk);
        return area;
    }
    std::vector<ChunkLight> lights() const { return lightArea(view(), contentTable()); }
    // Light of all blocks by index(), which counts from the bottom of the world.
    std::vector<LightValue> solve() const { return flatten(lights()); }
    std::vector<LightValue> flatten(const std::vector<ChunkLight>& lights) const {
        std::vector<LightValue> values;
        values.reserve(index(0, 0, heights.top));
        for (int z = heights.bottom; z < heights.top; ++z) {
            for (int y = 0; y < height(); ++y) {
                for (int x = 0; x < width(); ++x) {
                    values.push_back(lights[chunkIndex(x, y)].get(x & 15, y & 15, z));
                }
            }
        }
        return values;
    }

    static world::Chunk makeChunk(int cx, int cy, const Source& source, world::Heights heights = {}) {
        world::Chunk chunk(heights);
        std::array<world::BlockId, world::kBlocksPerSection> values;
        for (int section = heights.firstSection(); section < heights.endSection(); ++section) {
            for (int i = 0; i < world::kBlocksPerSection; ++i) {
                values[static_cast<std::size_t>(i)] =
                    source(cx * world::kChunkSize + (i & 15), cy * world::kChunkSize + ((i >> 4) & 15),
                           section * world::kSectionSize + (i >> 8));
            }
            chunk.setSection(section, world::Section::fromValues(values));
        }
        return chunk;
    }

    int chunksX, chunksY;
    world::Heights heights;
    std::vector<world::Chunk> chunks;
};

// Blocks of the random worlds lie below this, so that both the ground and the sky are there.
constexpr int kFilledHeight = 40;

inline world::BlockId anyBlock(std::uint32_t hash) {
    return static_cast<world::BlockId>(hash % contentBlocks().types().size());
}

inline std::uint32_t hashAt(int x, int y, int z, std::uint32_t seed) {
    return shared::hash3(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                         static_cast<std::uint32_t>(z), seed);
}

// One block in `airShare` is not air.
inline TestArea::Source scattered(std::uint32_t seed, std::uint32_t airShare) {
    return [=](int x, int y, int z) {
        const std::uint32_t hash = hashAt(x, y, z, seed);
        return z < kFilledHeight && hash % airShare == 0 ? anyBlock(hash / airShare) : world::kAir;
    };
}

// Rooms of stone with holes and a few lamps.
inline TestArea::Source caves(std::uint32_t seed) {
    return [=](int x, int y, int z) {
        const std::uint32_t hash = hashAt(x, y, z, seed);
        if (z >= kFilledHeight) return world::kAir;
        const bool isWall = x % 7 == 0 || y % 6 == 0 || z % 5 == 0;
        if (isWall) return hash % 12 == 0 ? world::kAir : contentBlock("stone");
        return hash % 90 == 0 ? anyBlock(hash / 90) : world::kAir;
    };
}

inline TestArea::Source layers(std::uint32_t seed) {
    return [=](int x, int y, int z) {
        const std::uint32_t hash = hashAt(x / 5, y / 5, z, seed);
        return z < kFilledHeight && hash % 6 == 0 ? anyBlock(hash / 6) : world::kAir;
    };
}

}  // namespace terrane::light
