// What an import read and what it did not understand, for the terminal and as a JSON file. One thread.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/formats/minecraft_chunk.h"

namespace terrane::app {

struct ImportReport {
    std::uint64_t chunks = 0;      // stored now
    std::uint64_t skipped = 0;     // had edits in the world already
    std::uint64_t unfinished = 0;  // of the stored ones: Minecraft has not generated all of them
    std::uint64_t damageCount = 0;
    std::vector<std::string> damaged;  // the first ones, a line each
    formats::ImportCounts counts;
};

void addTo(formats::ImportCounts& sum, const formats::ImportCounts& more);

// Keeps the first lines, and logs the first few.
void noteDamage(ImportReport& report, std::string line);

// A few lines on standard error: how much, what is unknown, what lies outside.
void logReport(const ImportReport& report);
[[nodiscard]] base::Result<void> writeReport(const ImportReport& report, const std::string& file);

}  // namespace terrane::app
