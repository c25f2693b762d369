// Images in memory and as PNG: textures, screenshots, golden images. Any thread may call the functions.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"

namespace terrane::base {

// A pixel has four bytes: red, green, blue (sRGB), alpha (not premultiplied). Row 0 is the top one.
struct Image {
    int width = 0;   // pixels
    int height = 0;  // pixels
    std::vector<std::uint8_t> rgba;
};

// Larger PNG files are refused, so that a small damaged file cannot allocate all memory: 2^26 pixels × 4
// bytes = 256 MiB.
constexpr std::int64_t kMaxImagePixels = std::int64_t{1} << 26;

// Decodes any kind of PNG to RGBA8. Errors begin with `name`.
[[nodiscard]] Result<Image> decodePng(std::string_view bytes, std::string_view name,
                                      std::int64_t maxPixels = kMaxImagePixels);

// Fails unless the image has at least one pixel and exactly the bytes of its size. The compressed bytes
// depend on the version of zlib: compare decoded images.
[[nodiscard]] Result<std::string> encodePng(const Image& image);
// Encodes like encodePng() in a quarter of the time; files are a fifth smaller to a third larger (measured on
// maps of 256×256 pixels). Writes no alpha if all pixels are opaque.
[[nodiscard]] Result<std::string> encodePngFast(const Image& image);

[[nodiscard]] Result<Image> readPng(const std::filesystem::path& path,
                                    std::int64_t maxPixels = kMaxImagePixels);
[[nodiscard]] Result<void> writePng(const std::filesystem::path& path, const Image& image);

}  // namespace terrane::base
