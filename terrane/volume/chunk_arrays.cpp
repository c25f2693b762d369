#include "terrane/volume/chunk_arrays.h"

#include <algorithm>
#include <cstring>

namespace terrane::volume {
namespace {

using Values = std::array<world::Section::Value, world::kBlocksPerSection>;

// Calls row(place in the section, place in the array, blocks) for each row along x of a section that lies in
// the part.
template <class Row>
void forEachRow(const ChunkPart& part, const BlockArea& area, int section, const Row& row) {
    const int low = section * world::kSectionSize;
    const int z0 = std::max(part.z0, low), z1 = std::min(part.z1, low + world::kSectionSize);
    const auto count = static_cast<std::size_t>(part.x1 - part.x0);
    for (int z = z0; z < z1; ++z) {
        const std::int64_t layer = part.first + (z - part.z0) * area.width() * area.depth();
        for (int y = part.y0; y < part.y1; ++y)
            row(static_cast<std::size_t>(part.x0 + y * world::kChunkSize + ((z - low) << 8)),
                static_cast<std::size_t>(layer + (y - part.y0) * area.width()), count);
    }
}

// Rows of whole chunks have a constant length, which compiles to two moves.
void copyRow(const world::BlockId* from, world::BlockId* to, std::size_t count) {
    if (count == world::kChunkSize)
        std::memcpy(to, from, world::kChunkSize * sizeof(world::BlockId));
    else
        std::memcpy(to, from, count * sizeof(world::BlockId));
}

int firstSection(const ChunkPart& part) {
    return part.z0 / world::kSectionSize;
}
int endSection(const ChunkPart& part) {
    return (part.z1 - 1) / world::kSectionSize + 1;
}

}  // namespace

LightLevels lightLevels(light::LightValue value) {
    const auto level = [value](int component) {
        return static_cast<std::uint8_t>(light::levelOf(value, component));
    };
    return {level(light::kDaylight), level(light::kRed), level(light::kGreen), level(light::kBlue)};
}

void copyBlocks(const world::Chunk& chunk, world::ChunkPos pos, const BlockArea& area,
                std::span<world::BlockId> blocks) {
    const ChunkPart part = partOf(area, pos);
    Values values;
    for (int s = firstSection(part); s < endSection(part); ++s) {
        const world::Section& section = chunk.section(s);
        if (section.isUniform() && section.uniformValue() == world::kAir) continue;
        section.unpack(values);
        forEachRow(part, area, s, [&](std::size_t from, std::size_t to, std::size_t count) {
            copyRow(&values[from], &blocks[to], count);
        });
    }
}

void copyLight(const light::ChunkLight& light, world::ChunkPos pos, const BlockArea& area,
               std::span<LightLevels> levels) {
    const ChunkPart part = partOf(area, pos);
    Values values;
    for (int s = firstSection(part); s < endSection(part); ++s) {
        light.brick(s).unpack(values);
        forEachRow(part, area, s, [&](std::size_t from, std::size_t to, std::size_t count) {
            for (std::size_t k = 0; k < count; ++k) levels[to + k] = lightLevels(values[from + k]);
        });
    }
}

std::int64_t writeBlocks(std::span<const world::BlockId> blocks, const BlockArea& area, world::ChunkPos pos,
                         world::Chunk& chunk) {
    const ChunkPart part = partOf(area, pos);
    const std::size_t step = blocks.size() == 1 ? 0 : 1;
    std::int64_t changed = 0;
    for (int s = firstSection(part); s < endSection(part); ++s)
        forEachRow(part, area, s, [&](std::size_t to, std::size_t from, std::size_t count) {
            for (std::size_t k = 0; k < count; ++k) {
                const auto at = static_cast<world::BlockIndex>((static_cast<std::size_t>(s) << 12) + to + k);
                const world::BlockId id = blocks[(from + k) * step];
                if (chunk.block(at) == id) continue;
                chunk.setBlock(at, id);
                ++changed;
            }
        });
    return changed;
}

}  // namespace terrane::volume
