// Counts of an import, imported and not understood, for the terminal and as a JSON file. One thread.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/formats/minecraft_chunk.h"

namespace terrane::app {

struct ImportReport {
    std::uint64_t chunks = 0;      // stored in this run
    std::uint64_t skipped = 0;     // already edited in the world
    std::uint64_t unfinished = 0;  // of the stored ones: Minecraft had not finished generating them
    std::uint64_t damageCount = 0;
    std::vector<std::string> damaged;  // the first ones, a line each
    formats::ImportCounts counts;
};

void addTo(formats::ImportCounts& sum, const formats::ImportCounts& more);

// Counts the damage. Keeps the first lines, and logs the first few.
void noteDamage(ImportReport& report, std::string line);

// Logs a summary: counts, unknown names, blocks out of range.
void logReport(const ImportReport& report);
[[nodiscard]] base::Result<void> writeReport(const ImportReport& report, const std::string& file);

}  // namespace terrane::app
