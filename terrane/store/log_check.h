// Checks the log beside a save (SQLite's write-ahead log). SQLite reads a log up to its first broken frame
// and ignores the rest silently: committed transactions would be lost. Called while the save is open for
// reading and nobody writes; any thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace terrane::store {

// Errors of the log, one line each; none if the log is intact, empty or missing. Reads it once, frame by
// frame.
std::vector<std::string> logProblems(const std::filesystem::path& save);

}  // namespace terrane::store
