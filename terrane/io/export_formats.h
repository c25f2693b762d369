// Writes a box of blocks, or its surface, in formats of other programs. One thread.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "terrane/base/result.h"
#include "terrane/io/export_source.h"

namespace terrane::io {

struct ExportedFile {
    std::string content;  // for people: "16×16×256 blocks"
    std::size_t bytes = 0;
};

// The mesh of the box, closed on all sides (glTF).
[[nodiscard]] base::Result<ExportedFile> exportGlb(const ExportSource& source,
                                                   const std::filesystem::path& output,
                                                   const Progress& progress = {});
// `mapping`: file of block names in addition to the built-in ones; empty: none.
[[nodiscard]] base::Result<ExportedFile> exportSchematic(const ExportSource& source,
                                                         const std::filesystem::path& output,
                                                         const std::string& mapping,
                                                         const Progress& progress = {});
// A model of MagicaVoxel.
[[nodiscard]] base::Result<ExportedFile> exportVox(const ExportSource& source,
                                                   const std::filesystem::path& output,
                                                   const Progress& progress = {});
// Block ids as uint16 [z, y, x], and their names in a file beside it, which adds .names.json to the name.
[[nodiscard]] base::Result<ExportedFile> exportNpy(const ExportSource& source,
                                                   const std::filesystem::path& output,
                                                   const Progress& progress = {});

// The height per column of the highest block that is solid or liquid; 0 if there is none.
// As uint16 [y, x].
[[nodiscard]] base::Result<ExportedFile> exportNpyHeights(const ExportSource& source,
                                                          const std::filesystem::path& output,
                                                          const Progress& progress = {});
// As a gray image of 8 or 16 bits per pixel: north up, east right.
[[nodiscard]] base::Result<ExportedFile> exportPngHeights(const ExportSource& source,
                                                          const std::filesystem::path& output, int bits,
                                                          const Progress& progress = {});

}  // namespace terrane::io
