// terrane export glb: writes the mesh of a box of blocks. Called by export_command.cpp.
#pragma once

#include "apps/terrane/formats/export_source.h"
#include "terrane/base/result.h"

namespace terrane::app {

[[nodiscard]] base::Result<void> exportGlb(ExportOptions& options);

// terrane export schem, vox, npy, npy-heights and png-heights: writes a box of blocks, or its surface. Called
// by export_command.cpp.
[[nodiscard]] base::Result<void> exportSchematic(ExportOptions& options);
[[nodiscard]] base::Result<void> exportVox(ExportOptions& options);
// Block ids as uint16 [z, y, x], and their names in a file beside it.
[[nodiscard]] base::Result<void> exportNpy(ExportOptions& options);
// The height per column of the highest block that is solid or liquid; 0 if there is none.
[[nodiscard]] base::Result<void> exportNpyHeights(ExportOptions& options);  // uint16 [y, x]
[[nodiscard]] base::Result<void> exportPngHeights(ExportOptions& options);  // north up, east right

}  // namespace terrane::app
