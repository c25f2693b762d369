#include "apps/terrane/window/pictures.h"

#include <fmt/format.h>

#include "apps/terrane/window/thumbnail.h"
#include "terrane/base/log.h"

namespace terrane::app {
namespace {

// The first free name of the form terrane-0001.png.
std::filesystem::path freeScreenshot(const std::filesystem::path& folder) {
    for (int number = 1;; ++number) {
        const std::filesystem::path path = folder / fmt::format("terrane-{:04}.png", number);
        std::error_code ignored;
        if (!std::filesystem::exists(path, ignored)) return path;
    }
}

}  // namespace

base::Result<std::filesystem::path> writeScreenshot(const std::filesystem::path& folder,
                                                    const base::Image& image) {
    std::error_code ignored;  // writePng() reports errors
    std::filesystem::create_directories(folder, ignored);
    const std::filesystem::path file = freeScreenshot(folder);
    TERRANE_TRY(base::writePng(file, image));
    return file;
}

void writeThumbnail(const std::filesystem::path& file, const base::Image& image) {
    const auto done = base::writePng(file, thumbnailFrom(image));
    if (!done) base::logInfo("{}", done.error().message);
}

}  // namespace terrane::app
