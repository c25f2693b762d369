// Files that a command writes, and the check that none of them is a file of its run.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "terrane/base/result.h"

namespace terrane::app {

// Marks an option as one that names a file to write: its folder must exist and be writable, and
// checkOutputs() knows it. Sets the type name; the caller adds the rest.
CLI::Option* writesFile(CLI::Option* option);
// The same for a folder, which is created if needed.
CLI::Option* writesFolder(CLI::Option* option);
// The same for a world, without a check of its folder.
CLI::Option* writesWorld(CLI::Option* option);

// Why the text does not name a file, existing or not, in an existing folder; empty: it does.
std::string isInAFolder(const std::string& text);

// Fails if a file or folder that the parsed command writes is also one that another option reads or writes:
// a world with its logs, locks and server's files, or a file; or if it is a file in a folder that another
// option reads. Sees through symbolic and hard links and other spellings of a path. Called between parsing
// and running, on the main thread.
[[nodiscard]] base::Result<void> checkOutputs(CLI::App& command);

}  // namespace terrane::app
