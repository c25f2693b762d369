// terrane import minecraft: chunks of region files into a world. Called by import_command.cpp.
#pragma once

#include "apps/terrane/formats/import_options.h"
#include "terrane/base/result.h"

namespace terrane::app {

// Chunks that have edits in the world are left as they are, so that a run that was cut short goes on where it
// was. What cannot be read is left out, counted and logged; options.exitCode is then 1.
[[nodiscard]] base::Result<void> importMinecraft(ImportOptions& options);

}  // namespace terrane::app
