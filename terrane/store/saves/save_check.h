// Checks a whole save for damage without changing it; takes as long as reading all of it. Any thread may use
// it. A save that another program writes is checked as of one moment, without its log, which changes
// meanwhile.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "terrane/store/chunk_store.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::store {

// Checks the log beside a save (SQLite's write-ahead log). SQLite reads a log up to its first broken frame
// and ignores the rest silently: committed transactions would be lost. It is called while the save is open
// for reading and no program writes it; any thread may call it. Errors of the log, one line each; none if the
// log is intact, empty or missing. Reads it once, frame by frame.
std::vector<std::string> logProblems(const std::filesystem::path& save);

struct DamagedChunk {
    world::ChunkPos pos;
    std::string problem;
};

struct CheckReport {
    std::int64_t format = 0;
    std::string inUse;  // see SaveFile::inUse; empty: no program writes it
    WorldIdentity identity;
    // Counts of stored chunks, including damaged ones: all levels, edited ones of level 0, levels above 0.
    std::size_t chunks = 0, editedChunks = 0, tiles = 0;
    std::uint64_t chunkBytes = 0;  // total data of the chunks
    std::uint64_t fileBytes = 0;   // size of the file and its log
    std::size_t quarantined = 0;   // rows quarantined earlier

    std::vector<std::string> fileProblems;   // problems of SQLite's pages and of the tables
    std::vector<DamagedChunk> damaged;       // the first 1,000
    std::size_t unlisted = 0;                // number of further damaged chunks
    std::vector<std::string> unknownBlocks;  // names that the registry lacks; not damage

    bool isDamaged() const { return !fileProblems.empty() || !damaged.empty(); }
};

void addDamage(CheckReport& report, world::ChunkPos pos, std::string problem);

// Fails if there is no save, or another program is creating or migrating it.
[[nodiscard]] base::Result<CheckReport> checkSave(const std::filesystem::path& path,
                                                  const world::BlockRegistry& registry);

}  // namespace terrane::store
