#include "terrane/formats/region_file.h"

#include <charconv>

#include "terrane/formats/nbt.h"

namespace terrane::formats {
namespace {

constexpr std::size_t kSectorBytes = 4096;
constexpr std::uint8_t kIsExternal = 0x80;

enum Compression : std::uint8_t { kGzip = 1, kZlib = 2, kUncompressed = 3, kLz4 = 4 };

std::uint32_t bigEndian(std::string_view bytes, std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < count; ++k) value = value << 8 | static_cast<std::uint8_t>(bytes[at + k]);
    return value;
}

// The file begins with 1,024 entries: three bytes for the first sector, one for the number of sectors.
std::uint32_t entryOf(std::string_view region, int number) {
    const auto at = static_cast<std::size_t>(number) * 4;
    return number >= 0 && number < kRegionChunks && region.size() >= at + 4 ? bigEndian(region, at, 4) : 0;
}

base::Result<std::string> decompressed(std::string_view bytes, std::uint8_t compression) {
    switch (compression) {
        case kGzip:
        case kZlib:
            return inflate(bytes, kMaxChunkBytes);
        case kUncompressed:
            if (bytes.size() > kMaxChunkBytes)
                return base::fail(base::ErrorCode::OutOfResources, "more than {} bytes", kMaxChunkBytes);
            return std::string(bytes);
        case kLz4:
            return base::fail(
                base::ErrorCode::Unsupported,
                "compressed by LZ4, which is not supported: set region-file-compression=deflate in "
                "server.properties, and optimize the world");
        default:
            return base::fail(base::ErrorCode::Unsupported, "compression {} is not supported", compression);
    }
}

}  // namespace

std::optional<RegionPos> regionPosOf(std::string_view fileName) {
    constexpr std::string_view kStart = "r.", kEnd = ".mca";
    if (!fileName.starts_with(kStart) || !fileName.ends_with(kEnd) ||
        fileName.size() < kStart.size() + kEnd.size())
        return std::nullopt;
    fileName.remove_prefix(kStart.size());
    fileName.remove_suffix(kEnd.size());
    RegionPos pos;
    const char* end = fileName.data() + fileName.size();
    const auto [afterX, badX] = std::from_chars(fileName.data(), end, pos.x);
    if (badX != std::errc() || afterX == end || *afterX != '.') return std::nullopt;
    const auto [afterZ, badZ] = std::from_chars(afterX + 1, end, pos.z);
    if (badZ != std::errc() || afterZ != end) return std::nullopt;
    return pos;
}

bool regionHasChunk(std::string_view region, int number) {
    return entryOf(region, number) != 0;
}

base::Result<std::string> readRegionChunk(std::string_view region, int number,
                                          const ExternalChunk& external) {
    const std::uint32_t entry = entryOf(region, number);
    if (entry == 0) return base::fail(base::ErrorCode::NotFound, "not in the file");
    const std::size_t start = std::size_t{entry >> 8} * kSectorBytes;
    if (start + 5 > region.size() || start < 2 * kSectorBytes)
        return base::fail(base::ErrorCode::Damaged, "begins at byte {}, outside the data of the file", start);
    const std::size_t length = bigEndian(region, start, 4);  // with the byte of the compression
    if (length == 0 || length > region.size() - start - 4)
        return base::fail(base::ErrorCode::Damaged, "ends outside the file");
    const auto compression = static_cast<std::uint8_t>(region[start + 4]);
    if ((compression & kIsExternal) == 0)
        return decompressed(region.substr(start + 5, length - 1), compression);
    if (!external) return base::fail(base::ErrorCode::NotFound, "is in a separate file");
    const auto bytes = TERRANE_TRY(external());
    return decompressed(bytes, static_cast<std::uint8_t>(compression & ~kIsExternal));
}

}  // namespace terrane::formats
