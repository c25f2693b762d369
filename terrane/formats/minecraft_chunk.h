// Converts a Minecraft chunk to a chunk of Terrane and counts what is unknown or left out. Called by `terrane
// import`. Plain functions; any thread.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

#include "terrane/formats/anvil_chunk.h"
#include "terrane/formats/block_mapping.h"
#include "terrane/world/chunk.h"

namespace terrane::formats {

// Sums over all chunks.
struct ImportCounts {
    std::map<std::string, std::uint64_t> blocks;         // all blocks read, by name without properties
    std::map<std::string, std::uint64_t> unknown;        // of these: those that became "missing"
    std::map<std::string, std::uint64_t> blockEntities;  // left out, by kind
    std::uint64_t below = 0, above = 0;  // blocks other than air outside our heights, left out
};

// The position of Minecraft's chunk x, z in our axes, -x - 1, z; the import may move it.
[[nodiscard]] world::ChunkPos chunkPosOf(const AnvilChunk& chunk);

// Adds `uses[k]` blocks of each `palette[k]` to the counts.
void addUses(std::span<const NamedState> palette, std::span<const std::uint64_t> uses,
             const BlockMapping& mapping, ImportCounts& counts);

// Height z is Minecraft's y + `shift`. Blocks outside 0…255 are counted and left out.
[[nodiscard]] world::Chunk toChunk(const AnvilChunk& chunk, const BlockMapping& mapping, int shift,
                                   ImportCounts& counts);

}  // namespace terrane::formats
