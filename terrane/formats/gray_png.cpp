#include "terrane/formats/gray_png.h"

#include <zlib.h>

#include <new>
#include <string_view>

#include "terrane/base/result.h"

namespace terrane::formats {
namespace {

void appendBigEndian(std::string& bytes, std::uint32_t value) {
    for (unsigned k = 4; k-- > 0;) bytes.push_back(static_cast<char>(value >> (8 * k)));
}

void appendPngChunk(std::string& png, std::string_view kind, std::string_view data) {
    appendBigEndian(png, static_cast<std::uint32_t>(data.size()));
    const std::size_t first = png.size();
    png += kind;
    png += data;
    const auto* checked = reinterpret_cast<const Bytef*>(png.data() + first);
    appendBigEndian(png, static_cast<std::uint32_t>(crc32_z(0, checked, png.size() - first)));
}

// Each row begins with a byte for its filter; each byte is stored as the difference to the one a pixel before
// (PNG specification, 9.2, "Sub").
std::string filteredRows(const GrayImage& image) {
    const std::size_t width = static_cast<std::size_t>(image.width), pixelBytes = image.bits == 16 ? 2 : 1;
    std::string rows, row;
    rows.reserve((width * pixelBytes + 1) * static_cast<std::size_t>(image.height));
    for (std::size_t first = 0; first < image.values.size(); first += width) {
        row.assign(pixelBytes, '\0');
        for (std::size_t x = 0; x < width; ++x) {
            const std::uint16_t value = image.values[first + x];
            if (pixelBytes == 2) row.push_back(static_cast<char>(value >> 8));
            row.push_back(static_cast<char>(value));
        }
        rows.push_back(1);
        for (std::size_t k = pixelBytes; k < row.size(); ++k)
            rows.push_back(static_cast<char>(row[k] - row[k - pixelBytes]));
    }
    return rows;
}

}  // namespace

std::string encodeGrayPng(const GrayImage& image) {
    base::require(image.bits == 8 || image.bits == 16, "encodeGrayPng: gray has 8 or 16 bits");
    base::require(image.width > 0 && image.height > 0 &&
                      image.values.size() ==
                          static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height),
                  "encodeGrayPng: each pixel needs a value, and there is at least one");
    std::string header;
    appendBigEndian(header, static_cast<std::uint32_t>(image.width));
    appendBigEndian(header, static_cast<std::uint32_t>(image.height));
    header.push_back(static_cast<char>(image.bits));
    header += std::string(4, '\0');  // gray, deflate, the usual filters, not interlaced
    const std::string rows = filteredRows(image);
    uLongf size = compressBound(rows.size());
    std::string data(size, '\0');
    if (compress(reinterpret_cast<Bytef*>(data.data()), &size, reinterpret_cast<const Bytef*>(rows.data()),
                 rows.size()) != Z_OK)
        throw std::bad_alloc();
    std::string png = "\x89PNG\r\n\x1a\n";
    appendPngChunk(png, "IHDR", header);
    appendPngChunk(png, "IDAT", std::string_view(data).substr(0, size));
    appendPngChunk(png, "IEND", "");
    return png;
}

}  // namespace terrane::formats
