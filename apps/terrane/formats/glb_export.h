// terrane export glb: writes the mesh of a box of blocks. Called by export_command.cpp.
#pragma once

#include "apps/terrane/formats/export_options.h"
#include "terrane/base/result.h"

namespace terrane::app {

[[nodiscard]] base::Result<void> exportGlb(ExportOptions& options);

}  // namespace terrane::app
