// Pictures that the window writes: screenshots, and the world's own for the list of worlds.
#pragma once

#include <filesystem>

#include "terrane/base/image.h"
#include "terrane/base/result.h"

namespace terrane::app {

// Into a new file of the folder, which is made with the first one; its path.
base::Result<std::filesystem::path> writeScreenshot(const std::filesystem::path& folder,
                                                    const base::Image& image);

// Over the one before. A picture that cannot be written is no loss: a line in the log.
void writeThumbnail(const std::filesystem::path& file, const base::Image& image);

}  // namespace terrane::app
