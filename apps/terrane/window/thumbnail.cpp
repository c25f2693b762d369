#include "apps/terrane/window/thumbnail.h"

#include <algorithm>
#include <cstddef>

namespace terrane::app {
namespace {

// Pixels of an image, the end excluded; not empty.
struct Part {
    int x0, y0, x1, y1;
};

void writeMean(const base::Image& image, const Part& part, std::uint8_t* out) {
    const auto [x0, y0, x1, y1] = part;
    unsigned sums[4] = {};
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
            const std::size_t at = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                        static_cast<std::size_t>(x));
            for (std::size_t k = 0; k < 4; ++k) sums[k] += image.rgba[at + k];
        }
    }
    const auto count = static_cast<unsigned>((x1 - x0) * (y1 - y0));
    for (std::size_t k = 0; k < 4; ++k) out[k] = static_cast<std::uint8_t>(sums[k] / count);
}

}  // namespace

base::Image thumbnailFrom(const base::Image& image) {
    if (image.width <= 0 || image.height <= 0) return {};
    const int usedWidth =
        std::max(1, std::min(image.width, image.height * kThumbnailWidth / kThumbnailHeight));
    const int usedHeight =
        std::max(1, std::min(image.height, usedWidth * kThumbnailHeight / kThumbnailWidth));
    base::Image small{std::min(usedWidth, kThumbnailWidth), std::min(usedHeight, kThumbnailHeight), {}};
    small.rgba.resize(4 * static_cast<std::size_t>(small.width) * static_cast<std::size_t>(small.height));
    const int left = (image.width - usedWidth) / 2, top = (image.height - usedHeight) / 2;
    std::uint8_t* out = small.rgba.data();
    for (int y = 0; y < small.height; ++y) {
        for (int x = 0; x < small.width; ++x, out += 4) {
            const int x0 = left + x * usedWidth / small.width, y0 = top + y * usedHeight / small.height;
            const int x1 = left + (x + 1) * usedWidth / small.width;
            const int y1 = top + (y + 1) * usedHeight / small.height;
            writeMean(image, {x0, y0, std::max(x1, x0 + 1), std::max(y1, y0 + 1)}, out);
        }
    }
    return small;
}

}  // namespace terrane::app
