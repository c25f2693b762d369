// libFuzzer: any bytes as the PNG of a resource pack. The first byte says how deep the rest goes:
//   0  the bytes themselves
//   1  a PNG whose checksums are made right
//   2  the size and kind of an image, then its data, which is compressed
#include <zlib.h>

#include <algorithm>
#include <string>
#include <vector>

#include "terrane/base/image.h"
#include "terrane/base/log.h"
#include "terrane/content/built_in.h"
#include "terrane/content/resource_pack.h"
#include "tests/fuzz/fuzz_folder.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

using namespace terrane;
using fuzz::FuzzInput;

const std::string kSignature = "\x89PNG\r\n\x1a\n";

void putNumber(std::string& bytes, std::size_t at, std::uint32_t value) {
    for (std::size_t k = 0; k < 4; ++k) bytes[at + k] = static_cast<char>(value >> (24 - 8 * k));
}

std::uint32_t checksum(std::string_view bytes) {
    return static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

// Corrects the checksum of each chunk: length, type, data, checksum.
std::string withChecksums(std::string png) {
    for (std::size_t at = kSignature.size(); at + 12 <= png.size();) {
        std::size_t length = 0;
        for (std::size_t k = 0; k < 4; ++k) length = length << 8 | static_cast<std::uint8_t>(png[at + k]);
        if (length > png.size() - at - 12) break;
        putNumber(png, at + 8 + length, checksum(std::string_view(png).substr(at + 4, length + 4)));
        at += length + 12;
    }
    return png;
}

void appendChunk(std::string& png, std::string_view type, std::string_view data) {
    png.append(4, '\0');
    putNumber(png, png.size() - 4, static_cast<std::uint32_t>(data.size()));
    const std::size_t begin = png.size();
    png.append(type).append(data).append(4, '\0');
    putNumber(png, png.size() - 4, checksum(std::string_view(png).substr(begin, type.size() + data.size())));
}

std::string built(FuzzInput& input) {
    static constexpr std::uint32_t kSides[] = {1, 2, 8, 16, 1024, 2048, 8192, 65536, 0x7fffffff};
    static constexpr char kColors[] = {0, 2, 3, 4, 6};
    std::string header(8, '\0');
    putNumber(header, 0, input.byte() % 2 ? input.oneOf(kSides) : input.byte());
    putNumber(header, 4, input.byte() % 2 ? input.oneOf(kSides) : input.byte());
    header += static_cast<char>(1 << input.byte() % 5);  // bits
    header += input.oneOf(kColors);
    header.append(2, '\0');
    header += static_cast<char>(input.byte() % 2);  // interlacing
    std::string png = kSignature;
    appendChunk(png, "IHDR", header);
    while (input.byte() % 2) {
        static constexpr std::string_view kTypes[] = {"PLTE", "tRNS", "gAMA", "cHRM", "sRGB", "iCCP", "tEXt"};
        const std::string_view type = input.oneOf(kTypes);
        appendChunk(png, type, input.text());
    }
    const std::string_view plain = input.restAsText();
    uLongf size = compressBound(static_cast<uLong>(plain.size()));
    std::string data(size, '\0');
    compress(reinterpret_cast<Bytef*>(data.data()), &size, reinterpret_cast<const Bytef*>(plain.data()),
             static_cast<uLong>(plain.size()));
    appendChunk(png, "IDAT", std::string_view(data).substr(0, size));
    appendChunk(png, "IEND", "");
    return png;
}

std::string pngOf(FuzzInput input) {
    const std::uint8_t depth = input.byte() % 3;
    if (depth == 2) return built(input);
    const std::string bytes(input.restAsText());
    return depth == 1 ? withChecksums(kSignature + bytes) : bytes;
}

void requireSameAgain(const base::Image& image) {
    const auto encoded = base::encodePng(image);
    fuzz::require(encoded.has_value());
    const auto back = base::decodePng(*encoded, "again");
    fuzz::require(back && back->width == image.width && back->height == image.height &&
                  back->rgba == image.rgba);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const world::BlockRegistry blocks = [] {
        base::setLogLevel(base::LogLevel::Silent);
        return *content::loadBlocks();
    }();
    const std::string png = pngOf(FuzzInput(data, size));
    fuzz::writeWhole(fuzz::fuzzFolder() / "stone.png", png);
    const auto textures = content::loadTextures(fuzz::fuzzFolder().string(), blocks);
    if (!textures) {
        fuzz::requireReason(textures.error());
        return 0;
    }
    const auto stone = (*textures)("stone");
    fuzz::require(stone && stone->width == stone->height && stone->width <= content::kMaxTextureSide);
    requireSameAgain(*stone);
    return 0;
}
