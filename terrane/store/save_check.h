// Looks through a whole save for damage, changing nothing. Any thread; it runs for as long as reading all of
// it takes. A save that another program writes is looked at as it was at one moment; its log is not, since it
// changes under the eyes of the check.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "terrane/store/chunk_store.h"
#include "terrane/world/block_registry.h"

namespace terrane::store {

struct DamagedChunk {
    world::ChunkPos pos;
    std::string problem;
};

struct CheckReport {
    std::int64_t format = 0;
    std::string inUse;  // as SaveFile::inUse; empty: nobody writes it
    WorldIdentity identity;
    // Stored, damaged ones included: of all levels, of level 0 with edits, of levels above 0.
    std::size_t chunks = 0, editedChunks = 0, tiles = 0;
    std::uint64_t chunkBytes = 0;  // of their data
    std::uint64_t fileBytes = 0;   // of the file with its log
    std::size_t quarantined = 0;   // rows that were found damaged before and put aside

    std::vector<std::string> fileProblems;   // of SQLite's pages and of the tables
    std::vector<DamagedChunk> damaged;       // the first 1,000
    std::size_t unlisted = 0;                // damaged ones beyond these
    std::vector<std::string> unknownBlocks;  // names the registry lacks; no damage

    bool isDamaged() const { return !fileProblems.empty() || !damaged.empty(); }
};

void addDamage(CheckReport& report, world::ChunkPos pos, std::string problem);

// An error where there is no save to look through, or another program is just making or migrating it.
[[nodiscard]] base::Result<CheckReport> checkSave(const std::filesystem::path& path,
                                                  const world::BlockRegistry& registry);

}  // namespace terrane::store
