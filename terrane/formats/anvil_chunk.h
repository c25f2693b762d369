// Decodes the blocks of a Minecraft chunk from its NBT: by names since 1.13, by numbers before. Called by
// `terrane import`. Plain values; any thread.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/formats/legacy_ids.h"
#include "terrane/formats/named_state.h"
#include "terrane/formats/nbt.h"

namespace terrane::formats {

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

// Damaged if a part is missing or a block has no palette entry.
[[nodiscard]] base::Result<AnvilChunk> decodeAnvilChunk(const NbtCompound& root, const LegacyIds& ids);

}  // namespace terrane::formats
