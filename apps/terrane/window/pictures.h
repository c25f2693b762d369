// Writes images of the window: screenshots, and the world's thumbnail for the list of worlds.
#pragma once

#include <filesystem>

#include "terrane/base/image.h"
#include "terrane/base/result.h"

namespace terrane::app {

// Writes a new file in the folder, creating the folder if needed; returns its path.
base::Result<std::filesystem::path> writeScreenshot(const std::filesystem::path& folder,
                                                    const base::Image& image);

// Overwrites the last thumbnail. A failure is only logged.
void writeThumbnail(const std::filesystem::path& file, const base::Image& image);

}  // namespace terrane::app
