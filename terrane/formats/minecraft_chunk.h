// Converts a Minecraft chunk to a chunk of Terrane and counts unknown and omitted blocks. `terrane import`
// calls it. The functions have no state; any thread may call them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/formats/block_mapping.h"
#include "terrane/formats/nbt.h"
#include "terrane/world/chunk.h"

namespace terrane::formats {

// Decodes the blocks of a Minecraft chunk from its NBT: by names since 1.13, by numbers before. `terrane
// import` calls it. All are plain values; any thread may use them.
constexpr int kAnvilSectionBlocks = 4096;

struct AnvilSection {
    int y = 0;                          // in sections of 16 blocks; below 0 since 1.18
    std::vector<NamedState> palette;    // not empty
    std::vector<std::uint16_t> blocks;  // x + 16 z + 256 y: palette entries; empty: all are the first one
};

struct AnvilChunk {
    std::int32_t x = 0, z = 0;                 // in chunks
    int dataVersion = 0;                       // 0: before 1.9
    bool isFinished = true;                    // false: Minecraft has not generated all of it
    std::vector<AnvilSection> sections;        // those with blocks, in the order of the file
    std::map<std::string, int> blockEntities;  // count by kind: chests, signs
};

// Decodes a chunk. Returns Damaged if a part is missing or a block has no palette entry.
[[nodiscard]] base::Result<AnvilChunk> decodeAnvilChunk(const NbtCompound& root, const LegacyIds& ids);

// The lowest and the highest section with blocks, air too, of a chunk that may be damaged. Nothing if it has
// none.
struct SectionRange {
    int lowest = 0, highest = 0;
};
[[nodiscard]] std::optional<SectionRange> sectionRangeOf(const NbtCompound& root);

// Sums over all chunks.
struct ImportCounts {
    std::map<std::string, std::uint64_t> blocks;         // all blocks read, by name without properties
    std::map<std::string, std::uint64_t> unknown;        // of these: those that became "missing"
    std::map<std::string, std::uint64_t> blockEntities;  // left out, by kind
    std::uint64_t below = 0, above = 0;  // blocks other than air outside the world's heights, left out
};

// Returns the position of Minecraft's chunk x, z in our axes, -x - 1, z; the import may move it.
[[nodiscard]] world::ChunkPos chunkPosOf(const AnvilChunk& chunk);

// Adds `uses[k]` blocks of each `palette[k]` to the counts.
void addUses(std::span<const NamedState> palette, std::span<const std::uint64_t> uses,
             const BlockMapping& mapping, ImportCounts& counts);

// Where heights go: z is Minecraft's y + `shift`, in a world of these heights.
struct AnvilPlacement {
    int shift = 0;
    world::Heights heights = {};
};

// Converts a chunk. Blocks outside the world's heights are counted and left out.
[[nodiscard]] world::Chunk toChunk(const AnvilChunk& chunk, const BlockMapping& mapping,
                                   const AnvilPlacement& placement, ImportCounts& counts);

}  // namespace terrane::formats
