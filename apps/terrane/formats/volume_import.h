// terrane import schem and vox: imports a box of blocks into a world or a structure file. Called by
// import_command.cpp.
#pragma once

#include "apps/terrane/formats/import_world.h"
#include "terrane/base/result.h"

namespace terrane::app {

[[nodiscard]] base::Result<void> importSchematic(ImportOptions& options);
[[nodiscard]] base::Result<void> importVox(ImportOptions& options);

}  // namespace terrane::app
