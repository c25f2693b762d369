// Which world a save is of, against what the command line asks for.
#pragma once

#include <CLI/CLI.hpp>

#include "apps/terrane/options.h"
#include "terrane/store/chunk_store.h"

namespace terrane::app {

// Of a new save.
store::WorldIdentity identityOf(const WorldOptions& options);

// Takes the save's seed and generator where the command line does not give them. An error where it gives
// others, or this program has another version of the generator.
base::Result<void> adoptIdentity(WorldOptions& options, const CLI::App& command,
                                 const store::WorldIdentity& saved, const std::string& path);

}  // namespace terrane::app
