#include "terrane/formats/minecraft_chunk.h"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace terrane::formats {
namespace {

constexpr int kSide = world::kChunkSize;
// Data version of snapshot 17w47a: from then on the upper half of a door has its facing, too.
constexpr int kNamesSince = 1451;

// The blocks and states of a whole chunk: 256 KiB.
struct ChunkValues {
    std::array<world::Section::Value, world::kBlocksPerChunk> ids{}, states{};
};

// Blocks of a section's palette entries, each looked up once.
std::vector<BlockAndState> mappedPalette(const AnvilSection& section, const BlockMapping& mapping) {
    std::vector<BlockAndState> blocks;
    for (const NamedState& state : section.palette) blocks.push_back(mapping.blockOf(state));
    return blocks;
}

void countBlocks(const AnvilSection& section, const BlockMapping& mapping, ImportCounts& counts) {
    std::vector<std::uint64_t> uses(section.palette.size());
    if (section.blocks.empty()) uses[0] = kAnvilSectionBlocks;
    for (const std::uint16_t entry : section.blocks) ++uses[entry];
    addUses(section.palette, uses, mapping, counts);
}

// Our x is Minecraft's -x: the blocks of a row are in reverse order.
void putSection(const AnvilSection& section, std::span<const BlockAndState> palette, int shift,
                ChunkValues& values, ImportCounts& counts) {
    for (int k = 0; k < kAnvilSectionBlocks; ++k) {
        const BlockAndState block =
            palette[section.blocks.empty() ? 0 : section.blocks[static_cast<std::size_t>(k)]];
        if (block.id == world::kAir) continue;
        const int z = section.y * kSide + k / (kSide * kSide) + shift;
        if (!world::isInHeight(z)) {
            ++(z < 0 ? counts.below : counts.above);
            continue;
        }
        const auto at = world::blockIndex(kSide - 1 - k % kSide, k / kSide % kSide, z);
        values.ids[at] = block.id;
        values.states[at] = block.state;
    }
}

// Up to 1.12 only the lower half of a door stores where it faces and whether it is open: copies that to the
// upper half.
void completeDoors(world::BlockId door, world::BlockId top, ChunkValues& values) {
    constexpr std::size_t kLayer = kSide * kSide;
    for (std::size_t k = kLayer; k < values.ids.size(); ++k)
        if (values.ids[k] == top && values.ids[k - kLayer] == door)
            values.states[k] = values.states[k - kLayer];
}

world::Chunk chunkFrom(const ChunkValues& values) {
    world::Chunk chunk;
    for (int s = 0; s < world::kSectionsPerChunk; ++s) {
        const auto first = static_cast<std::size_t>(s) * world::kBlocksPerSection;
        const auto part = [first](std::span<const world::Section::Value> all) {
            const auto section = all.subspan(first, world::kBlocksPerSection);
            return world::Section::fromValues(section.first<world::kBlocksPerSection>());
        };
        chunk.setSection(s, part(values.ids));
        chunk.setBlockStateSection(s, part(values.states));
    }
    return chunk;
}

}  // namespace

world::ChunkPos chunkPosOf(const AnvilChunk& chunk) {
    return {-1 - chunk.x, chunk.z};
}

void addUses(std::span<const NamedState> palette, std::span<const std::uint64_t> uses,
             const BlockMapping& mapping, ImportCounts& counts) {
    for (std::size_t k = 0; k < uses.size(); ++k) {
        if (uses[k] == 0) continue;
        counts.blocks[palette[k].name] += uses[k];
        if (!mapping.isKnown(palette[k])) counts.unknown[textOf(palette[k])] += uses[k];
    }
}

world::Chunk toChunk(const AnvilChunk& chunk, const BlockMapping& mapping, int shift, ImportCounts& counts) {
    const auto values = std::make_unique<ChunkValues>();
    for (const AnvilSection& section : chunk.sections) {
        countBlocks(section, mapping, counts);
        putSection(section, mappedPalette(section, mapping), shift, *values, counts);
    }
    for (const auto& [kind, count] : chunk.blockEntities)
        counts.blockEntities[kind] += static_cast<std::uint64_t>(count);
    if (chunk.dataVersion < kNamesSince) {
        for (const auto& [door, top] : mapping.doors()) completeDoors(door, top, *values);
    }
    return chunkFrom(*values);
}

}  // namespace terrane::formats
