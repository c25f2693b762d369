// A chunk of Minecraft as a chunk of Terrane, and what of it was not understood. Called by `terrane import`.
// Plain functions; any thread.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "terrane/formats/anvil_chunk.h"
#include "terrane/formats/block_mapping.h"
#include "terrane/world/chunk.h"

namespace terrane::formats {

// Summed over chunks.
struct ImportCounts {
    std::map<std::string, std::uint64_t> blocks;         // all that were read, by name without properties
    std::map<std::string, std::uint64_t> unknown;        // of these: what became "missing"
    std::map<std::string, std::uint64_t> blockEntities;  // left out, by kind
    std::uint64_t below = 0, above = 0;  // blocks but air outside our heights, which are left out
};

// Where Minecraft's chunk x, z comes to lie before it is moved: -x - 1, z.
[[nodiscard]] world::ChunkPos chunkPosOf(const AnvilChunk& chunk);

// Height z is Minecraft's y + `shift`. Blocks outside 0…255 are counted and left out.
[[nodiscard]] world::Chunk toChunk(const AnvilChunk& chunk, const BlockMapping& mapping, int shift,
                                   ImportCounts& counts);

}  // namespace terrane::formats
