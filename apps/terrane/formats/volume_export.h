// terrane export schem, vox, npy, npy-heights and png-heights: a box of blocks, or its surface, as a file.
// Called by export_command.cpp.
#pragma once

#include "apps/terrane/formats/export_options.h"
#include "terrane/base/result.h"

namespace terrane::app {

[[nodiscard]] base::Result<void> exportSchematic(ExportOptions& options);
[[nodiscard]] base::Result<void> exportVox(ExportOptions& options);
// Numbers of blocks as uint16 [z, y, x], and their names in a file beside it.
[[nodiscard]] base::Result<void> exportNpy(ExportOptions& options);
// How high the highest block of each column lies that bodies do not pass, or that is liquid; 0 where there is
// none.
[[nodiscard]] base::Result<void> exportNpyHeights(ExportOptions& options);  // uint16 [y, x]
[[nodiscard]] base::Result<void> exportPngHeights(ExportOptions& options);  // as maps: north up, east right

}  // namespace terrane::app
