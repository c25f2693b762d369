// Gray images as PNG, for heights: base/image.h has only colors. The functions have no state; any thread may
// call them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace terrane::formats {

struct GrayImage {
    int width = 0, height = 0;          // pixels, each at least 1
    int bits = 8;                       // 8 or 16 a pixel
    std::vector<std::uint16_t> values;  // row 0 is the top one; of 8 bits below 256
};

// Encodes the image as PNG. The compressed bytes depend on the version of zlib.
[[nodiscard]] std::string encodeGrayPng(const GrayImage& image);

}  // namespace terrane::formats
