// Opens the world that an import writes into, with its blocks, store and generators. Called by the import
// commands.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/terrane/options.h"
#include "terrane/base/result.h"
#include "terrane/formats/minecraft_chunk.h"
#include "terrane/gen/level_generators.h"
#include "terrane/pack/content.h"
#include "terrane/store/chunk_store.h"
#include "terrane/world/coords.h"

namespace terrane::app {

// Options of `terrane import`. A plain value.
struct ImportOptions {
    std::string source;
    WorldOptions world;
    SaveOptions save;
    std::string mapping, report;           // files; empty: none
    std::string dimension = "overworld";   // of a Minecraft world
    std::optional<world::ChunkArea> area;  // x0, z0, x1, z1 in its chunks
    int shift = 0;                         // blocks added to heights
    std::string at;                        // "X,Y" or "X,Y,Z" in blocks; empty: 0
    std::string output;                    // a structure file instead of a world
    bool skipsAir = false;                 // air of the source leaves the world as it is
    int exitCode = 0;                      // after the run
};

// Counts of an import, imported and not understood, for the terminal and as a JSON file. One thread.
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

// Logs a summary: counts, unknown names, blocks out of range.
void logReport(const ImportReport& report);
[[nodiscard]] std::string jsonOf(const ImportReport& report);
[[nodiscard]] base::Result<void> writeReport(const ImportReport& report, const std::string& file);

struct ImportWorld {
    pack::Content content;
    std::unique_ptr<gen::LevelGenerators> generators;  // outlives the store
    std::unique_ptr<store::ChunkStore> store;
};

// `content`: loaded by the caller first, so that errors of a mapping are found before a world is created.
// Opens the world, creating it if needed; sets seed and generator in `options` to its own. Distant tiles
// follow the imported chunks.
[[nodiscard]] base::Result<ImportWorld> openImportWorld(ImportOptions& options, pack::Content content);

}  // namespace terrane::app
