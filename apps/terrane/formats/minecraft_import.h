// terrane import minecraft: imports chunks of region files into a world. Called by import_command.cpp.
#pragma once

#include "apps/terrane/formats/import_options.h"
#include "terrane/base/result.h"

namespace terrane::app {

// Chunks with edits in the world are kept, so a stopped run can continue. Chunks that cannot be read are
// skipped, counted and logged; options.exitCode is then 1.
[[nodiscard]] base::Result<void> importMinecraft(ImportOptions& options);

}  // namespace terrane::app
