// Whether the log beside a save (SQLite's write-ahead log) is whole. SQLite takes a log up to its first
// broken frame and passes over the rest in silence: transactions that were committed would be gone. Called
// while the save is open to read and nobody writes; any thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace terrane::store {

// What is wrong with it, a line each. Nothing where the log is whole, empty or not there. Reads the log once,
// a frame at a time.
std::vector<std::string> logProblems(const std::filesystem::path& save);

}  // namespace terrane::store
