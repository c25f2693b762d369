#include "terrane/formats/region_file.h"

#include <lz4.h>
#include <xxhash.h>

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

// Minecraft compresses with lz4-java's LZ4BlockOutputStream, whose stream is not LZ4's frame format: blocks
// of a header and data, at the end a block of size 0. The header has, little-endian:
//   0   8   "LZ4Block"
//   8   1   0x10 as it is or 0x20 LZ4, plus log2 of the largest block's size less 10
//   9   4   bytes of data in the stream
//   13  4   decompressed
//   17  4   the lower 28 bits of XXH32 of the decompressed bytes
constexpr std::string_view kLz4Magic = "LZ4Block";
constexpr std::size_t kLz4HeaderBytes = 21;
constexpr std::uint8_t kLz4Raw = 0x10, kLz4Packed = 0x20;
constexpr XXH32_hash_t kLz4Seed = 0x9747b28c, kLz4HashMask = 0x0fffffff;
constexpr std::size_t kMaxLz4Ratio = 255;  // a byte of a length stands for at most as many bytes

struct Lz4Header {
    std::uint8_t method = 0;
    std::size_t packedBytes = 0, bytes = 0;
    std::uint32_t hash = 0;
};

std::uint32_t lz4Number(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t k = 4; k-- > 0;) value = value << 8 | static_cast<std::uint8_t>(bytes[at + k]);
    return value;
}

base::Result<Lz4Header> lz4HeaderOf(std::string_view bytes) {
    if (bytes.size() < kLz4HeaderBytes || !bytes.starts_with(kLz4Magic))
        return base::fail(base::ErrorCode::Damaged, "the LZ4 data are cut off, or are none");
    Lz4Header header{static_cast<std::uint8_t>(bytes[8] & 0xf0), lz4Number(bytes, 9), lz4Number(bytes, 13),
                     lz4Number(bytes, 17)};
    const bool isRaw = header.method == kLz4Raw;
    const bool isValid =
        (isRaw || header.method == kLz4Packed) && (header.packedBytes == 0) == (header.bytes == 0) &&
        (!isRaw || header.packedBytes == header.bytes) && header.bytes / kMaxLz4Ratio <= header.packedBytes;
    if (!isValid) return base::fail(base::ErrorCode::Damaged, "the LZ4 data are damaged");
    if (header.packedBytes > bytes.size() - kLz4HeaderBytes)
        return base::fail(base::ErrorCode::Damaged, "the LZ4 data are cut off");
    return header;
}

// Appends the block's data, of which `out` may have at most `maxBytes`.
base::Result<void> appendLz4Block(const Lz4Header& header, std::string_view data, std::size_t maxBytes,
                                  std::string& out) {
    if (header.bytes > maxBytes - out.size())
        return base::fail(base::ErrorCode::OutOfResources, "more than {} bytes when decompressed", maxBytes);
    const std::size_t done = out.size();
    if (header.method == kLz4Raw) {
        out += data;
    } else {
        out.resize(done + header.bytes);
        const int count = LZ4_decompress_safe(data.data(), out.data() + done, static_cast<int>(data.size()),
                                              static_cast<int>(header.bytes));
        if (count < 0 || static_cast<std::size_t>(count) != header.bytes)
            return base::fail(base::ErrorCode::Damaged, "the LZ4 data are damaged");
    }
    if ((XXH32(out.data() + done, header.bytes, kLz4Seed) & kLz4HashMask) != header.hash)
        return base::fail(base::ErrorCode::Damaged, "the LZ4 data have another checksum");
    return {};
}

// Minecraft stops reading at the end of the NBT, so a stream that ends without the empty block is whole, too.
base::Result<std::string> lz4Decompressed(std::string_view bytes, std::size_t maxBytes) {
    std::string out;
    do {
        const auto header = TERRANE_TRY(lz4HeaderOf(bytes));
        if (header.bytes == 0) break;
        bytes.remove_prefix(kLz4HeaderBytes);
        TERRANE_TRY(appendLz4Block(header, bytes.substr(0, header.packedBytes), maxBytes, out));
        bytes.remove_prefix(header.packedBytes);
    } while (!bytes.empty());
    return out;
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
            return lz4Decompressed(bytes, kMaxChunkBytes);
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
