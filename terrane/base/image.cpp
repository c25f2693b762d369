#include "terrane/base/image.h"

#include <png.h>

#include <cassert>
#include <cstddef>

#include "terrane/base/files.h"

namespace terrane::base {

namespace {

// png_image with its memory freed on every way out.
struct PngImage : png_image {
    PngImage() : png_image{} { version = PNG_IMAGE_VERSION; }
    ~PngImage() { png_image_free(this); }
    PngImage(const PngImage&) = delete;
    PngImage& operator=(const PngImage&) = delete;
};

std::uint32_t bigEndian32(std::string_view bytes) {
    assert(bytes.size() >= 4 && "four bytes make the number");
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes[i]);
    return value;
}

// libpng stops after the last row, so it accepts a file whose end is missing. A PNG is 8 bytes of signature,
// then chunks of length (4), type (4), data and checksum (4); the last is IEND.
bool isComplete(std::string_view bytes) {
    constexpr std::size_t kSignatureBytes = 8;
    constexpr std::size_t kChunkFrameBytes = 12;
    std::size_t offset = kSignatureBytes;
    while (offset <= bytes.size() && bytes.size() - offset >= kChunkFrameBytes) {
        const std::size_t chunkBytes = kChunkFrameBytes + bigEndian32(bytes.substr(offset, 4));
        if (chunkBytes > bytes.size() - offset) return false;
        if (bytes.substr(offset + 4, 4) == "IEND") return true;
        offset += chunkBytes;
    }
    return false;
}

}  // namespace

Result<Image> decodePng(std::string_view bytes, std::string_view name, std::int64_t maxPixels) {
    PngImage png;
    if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) {
        return fail("{}: cannot be read as PNG: {}", name, png.message);
    }
    if (!isComplete(bytes)) return fail("{}: cannot be read as PNG: the file ends early", name);
    if (std::int64_t{png.width} * png.height > maxPixels) {
        return fail("{}: {} × {} pixels are more than the {} allowed", name, png.width, png.height,
                    maxPixels);
    }
    png.format = PNG_FORMAT_RGBA;
    Image image;
    image.width = static_cast<int>(png.width);
    image.height = static_cast<int>(png.height);
    image.rgba.resize(PNG_IMAGE_SIZE(png));
    if (png_image_finish_read(&png, nullptr, image.rgba.data(), 0, nullptr) == 0) {
        return fail("{}: cannot be read as PNG: {}", name, png.message);
    }
    return image;
}

namespace {

// `pixels` have the format png.format.
Result<std::string> encode(PngImage& png, const std::uint8_t* pixels) {
    png_alloc_size_t sizeBytes = PNG_IMAGE_PNG_SIZE_MAX(png);
    std::string bytes(sizeBytes, '\0');
    if (png_image_write_to_memory(&png, bytes.data(), &sizeBytes, 0, pixels, 0, nullptr) == 0) {
        return fail("{} × {} pixels cannot be written as PNG: {}", png.width, png.height, png.message);
    }
    bytes.resize(sizeBytes);
    return bytes;
}

Result<void> setSize(PngImage& png, const Image& image) {
    if (image.width < 1 || image.height < 1)
        return fail(ErrorCode::BadInput, "an image of {} × {} pixels cannot be a PNG", image.width,
                    image.height);
    png.width = static_cast<png_uint_32>(image.width);
    png.height = static_cast<png_uint_32>(image.height);
    png.format = PNG_FORMAT_RGBA;
    if (image.rgba.size() != std::size_t{png.width} * png.height * 4)
        return fail(ErrorCode::BadInput, "an image of {} × {} pixels has {} bytes, expected 4 per pixel",
                    image.width, image.height, image.rgba.size());
    return {};
}

}  // namespace

Result<std::string> encodePng(const Image& image) {
    PngImage png;
    TERRANE_TRY(setSize(png, image));
    return encode(png, image.rgba.data());
}

Result<std::string> encodePngFast(const Image& image) {
    PngImage png;
    TERRANE_TRY(setSize(png, image));
    png.flags |= PNG_IMAGE_FLAG_FAST;
    std::vector<std::uint8_t> rgb;
    for (std::size_t k = 0; k < image.rgba.size(); k += 4) {
        if (image.rgba[k + 3] != 255) return encode(png, image.rgba.data());
        rgb.insert(rgb.end(), {image.rgba[k], image.rgba[k + 1], image.rgba[k + 2]});
    }
    png.format = PNG_FORMAT_RGB;
    return encode(png, rgb.data());
}

Result<Image> readPng(const std::filesystem::path& path, std::int64_t maxPixels) {
    const std::string bytes = TERRANE_TRY(readFile(path));
    return decodePng(bytes, path.string(), maxPixels);
}

Result<void> writePng(const std::filesystem::path& path, const Image& image) {
    const Result<std::string> bytes = encodePng(image);
    if (!bytes) return fail("{}: {}", path.string(), bytes.error().message);
    return writeFile(path, *bytes);
}

}  // namespace terrane::base
