// OpenEXR files of what a path tracer has found, as floats: R, G, B; albedo.R, .G, .B; normal.X, .Y, .Z;
// Z (depth along the view in blocks, 0 for the sky); variance (of R, G and B together).
#pragma once

#include <filesystem>

#include "terrane/path/film.h"

namespace terrane::path {

struct ExrNotes {
    std::uint32_t samples = 0;
    bool isDenoised = false;
};

// Fails with ErrorCode::Unsupported in a build without OpenEXR.
[[nodiscard]] base::Result<void> writeExr(const std::filesystem::path& path, const Means& means,
                                          const ExrNotes& notes);
bool hasExr();

}  // namespace terrane::path
