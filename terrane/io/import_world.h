// What the imports of other programs' files have in common: the source, the world that they write into, and
// counts of what was read. One thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/formats/minecraft_chunk.h"
#include "terrane/gen/level_generators.h"
#include "terrane/io/world_options.h"
#include "terrane/pack/content.h"
#include "terrane/store/chunk_store.h"

namespace terrane::io {

struct ImportOptions {
    std::filesystem::path source;
    WorldOptions world;
    SaveOptions save;     // the world is created if needed
    std::string mapping;  // file of block names in addition to the built-in ones; empty: none
};

// Counts of an import: imported, and not understood.
struct ImportReport {
    std::uint64_t chunks = 0;      // stored in this run
    std::uint64_t skipped = 0;     // already edited in the world
    std::uint64_t unfinished = 0;  // of the stored ones: Minecraft had not finished generating them
    std::uint64_t empty = 0;       // not stored: without blocks
    std::uint64_t damageCount = 0;
    std::vector<std::string> damaged;  // the first ones, a line each
    formats::ImportCounts counts;
};

void addTo(formats::ImportCounts& sum, const formats::ImportCounts& more);

// Counts the damage. Keeps the first lines, and logs the first few.
void noteDamage(ImportReport& report, std::string line);

struct ImportWorld {
    pack::Content content;
    std::unique_ptr<gen::LevelGenerators> generators;  // outlives the store
    std::unique_ptr<store::ChunkStore> store;
    unsigned threads = 1;
};

// `content`: loaded by the caller first, so that errors of a mapping are found before a world is created.
// Opens the world, creating it if needed; sets seed, generator and heights in `options` to its own. Distant
// tiles follow the imported chunks.
[[nodiscard]] base::Result<ImportWorld> openImportWorld(ImportOptions& options, pack::Content content);

}  // namespace terrane::io
