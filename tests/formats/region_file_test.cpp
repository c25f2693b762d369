#include "terrane/formats/region_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lz4.h>
#include <xxhash.h>
#include <zlib.h>

#include <random>

#include "terrane/formats/nbt.h"

namespace terrane::formats {
namespace {

using testing::HasSubstr;

constexpr std::size_t kSector = 4096;

std::string zlibOf(std::string_view bytes) {
    uLongf size = compressBound(bytes.size());
    std::string out(size, '\0');
    compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
             bytes.size());
    out.resize(size);
    return out;
}

void put(std::string& bytes, std::size_t at, std::uint32_t value, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) bytes[at + k] = static_cast<char>(value >> (8 * (count - 1 - k)));
}

// A block of lz4-java's stream, its numbers little-endian. `method`: 0x10 as it is, 0x20 LZ4.
std::string lz4Block(std::string_view data, std::uint8_t method) {
    std::string packed(data);
    if (method == 0x20) {
        packed.resize(static_cast<std::size_t>(LZ4_compressBound(static_cast<int>(data.size()))));
        packed.resize(static_cast<std::size_t>(LZ4_compress_default(
            data.data(), packed.data(), static_cast<int>(data.size()), static_cast<int>(packed.size()))));
    }
    std::string block = "LZ4Block" + std::string(1, static_cast<char>(method | 6));
    const auto number = [&](std::size_t value) {
        for (int k = 0; k < 4; ++k) block.push_back(static_cast<char>(value >> (8 * k)));
    };
    number(packed.size());
    number(data.size());
    number(data.empty() ? 0 : XXH32(data.data(), data.size(), 0x9747b28c) & 0xfffffffu);
    return block + packed;
}

// Blocks of 64 KiB, as Minecraft writes them, and the empty block at the end.
std::string lz4Of(std::string_view data) {
    constexpr std::size_t kBlock = std::size_t{64} << 10;
    std::string stream;
    for (std::size_t at = 0; at < data.size(); at += kBlock)
        stream += lz4Block(data.substr(at, kBlock), 0x20);
    return stream + lz4Block("", 0x10);
}

// A file with one chunk in its third sector.
std::string regionWith(int number, std::uint8_t compression, std::string_view data) {
    std::string region(2 * kSector, '\0');
    put(region, static_cast<std::size_t>(number) * 4, 2, 3);
    region[static_cast<std::size_t>(number) * 4 + 3] = static_cast<char>(1 + data.size() / kSector);
    region += std::string(5, '\0');
    put(region, 2 * kSector, static_cast<std::uint32_t>(data.size() + 1), 4);
    region[2 * kSector + 4] = static_cast<char>(compression);
    region += data;
    region.resize((region.size() + kSector - 1) / kSector * kSector);
    return region;
}

std::string regionError(const base::Result<std::string>& result) {
    return result ? "" : result.error().message;
}

TEST(RegionFile, ReadsChunksOfEachCompression) {
    const std::string data = "some bytes that are to be a chunk";
    EXPECT_EQ(*readRegionChunk(regionWith(0, 1, gzip(data)), 0, {}), data);
    EXPECT_EQ(*readRegionChunk(regionWith(1023, 2, zlibOf(data)), 1023, {}), data);
    EXPECT_EQ(*readRegionChunk(regionWith(33, 3, data), 33, {}), data);
    EXPECT_EQ(*readRegionChunk(regionWith(5, 4, lz4Of(data)), 5, {}), data);
    EXPECT_THAT(regionError(readRegionChunk(regionWith(5, 127, data), 5, {})), HasSubstr("compression 127"));
}

// Bytes as lz4-java 1.10 writes them, with the checksum that it computes.
TEST(RegionFile, ReadsStreamsOfLz4Java) {
    using namespace std::string_literals;
    const std::string raw =
        "LZ4Block\x16\x07\0\0\0\x07\0\0\0\x56\x38\xc9\x09PumpkinLZ4Block\x16\0\0\0\0\0\0\0\0\0\0\0\0"s;
    EXPECT_EQ(*readRegionChunk(regionWith(0, 4, raw), 0, {}), "Pumpkin");
    const std::string packed =
        "LZ4Block\x26\x11\0\0\0\x8c\0\0\0\xd8\x90\xa1\0\x7fterrane\x07\0mPrrane"
        "LZ4Block\x16\0\0\0\0\0\0\0\0\0\0\0\0"s;
    std::string expected;
    for (int k = 0; k < 20; ++k) expected += "terrane";
    EXPECT_EQ(*readRegionChunk(regionWith(0, 4, packed), 0, {}), expected);
    EXPECT_EQ(*readRegionChunk(regionWith(0, 0x84, ""), 0, [&] { return base::Result<std::string>(packed); }),
              expected);
}

TEST(RegionFile, ReadsLz4OfSeveralBlocks) {
    std::mt19937 random(3);
    for (const std::size_t size : {0u, 1u, 65'535u, 65'536u, 65'537u, 400'000u}) {
        std::string data(size, '\0');
        for (char& byte : data) byte = static_cast<char>(random() % 3);
        EXPECT_EQ(readRegionChunk(regionWith(0, 4, lz4Of(data)), 0, {}).value(), data) << size;
    }
    // Minecraft stops reading where its data end, so the empty block at the end may be missing.
    EXPECT_EQ(*readRegionChunk(regionWith(0, 4, lz4Block("ab", 0x10) + lz4Block("cd", 0x20)), 0, {}), "abcd");
}

TEST(RegionFile, TellsWhatIsWrongWithLz4) {
    const auto errorOf = [](std::string_view stream) {
        return regionError(readRegionChunk(regionWith(0, 4, stream), 0, {}));
    };
    const std::string good = lz4Of("some bytes that are to be a chunk, some bytes that are to be a chunk");
    ASSERT_EQ(errorOf(good), "");
    EXPECT_THAT(errorOf(""), HasSubstr("LZ4"));
    // Cut off anywhere but between the two blocks.
    const std::size_t first = good.size() - 21;
    for (std::size_t size = 1; size < good.size(); ++size)
        ASSERT_EQ(errorOf(good.substr(0, size)).find("LZ4") != std::string::npos, size != first) << size;
    // No byte of the first block may differ, but the lower four bits of its method, its largest size.
    for (std::size_t at = 0; at < first; ++at) {
        std::string bad = good;
        bad[at] = static_cast<char>(bad[at] ^ 0x40);
        ASSERT_THAT(errorOf(bad), HasSubstr("LZ4")) << at;
    }
    // Sizes that no data can have allocate nothing.
    std::string large = good;
    put(large, 13, 0xffffff7f, 4);
    EXPECT_THAT(errorOf(large), HasSubstr("LZ4"));
    put(large, 13, 0xffffffff, 4);
    EXPECT_THAT(errorOf(large), HasSubstr("LZ4"));
}

TEST(RegionFile, DecompressesNoMoreLz4ThanItMay) {
    const std::string part(std::size_t{8} << 20, 'x');
    std::string bomb;
    for (int k = 0; k < 4; ++k) bomb += lz4Block(part, 0x20);
    EXPECT_LT(bomb.size(), 200'000u);
    EXPECT_EQ(readRegionChunk(regionWith(0, 4, bomb), 0, {}).value().size(), kMaxChunkBytes);
    EXPECT_THAT(regionError(readRegionChunk(regionWith(0, 4, bomb + lz4Block("x", 0x10)), 0, {})),
                HasSubstr("more than"));
}

TEST(RegionFile, ReadsChunksInFilesOfTheirOwn) {
    const std::string region = regionWith(7, 0x82, "");
    EXPECT_EQ(*readRegionChunk(region, 7, [] { return base::Result<std::string>(zlibOf("outside")); }),
              "outside");
    EXPECT_THAT(
        regionError(readRegionChunk(
            region, 7, []() -> base::Result<std::string> { return base::fail("c.7.0.mcc: missing"); })),
        HasSubstr("c.7.0.mcc"));
    EXPECT_THAT(regionError(readRegionChunk(region, 7, {})), HasSubstr("separate file"));
}

TEST(RegionFile, KnowsWhichChunksAreThere) {
    const std::string region = regionWith(40, 3, "x");
    for (int number = -1; number <= kRegionChunks; ++number)
        EXPECT_EQ(regionHasChunk(region, number), number == 40) << number;
    EXPECT_FALSE(regionHasChunk("", 0));
    EXPECT_FALSE(readRegionChunk(region, 41, {}));
}

TEST(RegionFile, RefusesWhatLiesOutside) {
    std::string region = regionWith(0, 2, zlibOf("data"));
    EXPECT_THAT(regionError(readRegionChunk(region.substr(0, 2 * kSector + 4), 0, {})), HasSubstr("outside"));
    EXPECT_THAT(regionError(readRegionChunk(region.substr(0, 2 * kSector + 9), 0, {})),
                HasSubstr("ends outside"));
    put(region, 0, 1, 3);
    EXPECT_THAT(regionError(readRegionChunk(region, 0, {})), HasSubstr("outside"));
    put(region, 0, 0xffffff, 3);
    EXPECT_THAT(regionError(readRegionChunk(region, 0, {})), HasSubstr("outside"));
    region = regionWith(0, 2, zlibOf("data"));
    put(region, 2 * kSector, 0, 4);
    EXPECT_THAT(regionError(readRegionChunk(region, 0, {})), HasSubstr("ends outside"));
    EXPECT_THAT(regionError(readRegionChunk(regionWith(0, 2, "no zlib"), 0, {})), HasSubstr("damaged"));
    EXPECT_THAT(regionError(readRegionChunk(regionWith(0, 2, zlibOf("data").substr(0, 6)), 0, {})),
                HasSubstr("cut off"));
}

TEST(RegionFile, InflatesNoMoreThanItMay) {
    const std::string bomb = gzip(std::string(kMaxChunkBytes + 1, 'x'));
    EXPECT_LT(bomb.size(), 100'000u);
    EXPECT_THAT(regionError(inflate(bomb, kMaxChunkBytes)), HasSubstr("more than"));
    EXPECT_EQ(inflate(bomb, kMaxChunkBytes + 1)->size(), kMaxChunkBytes + 1);
    EXPECT_EQ(*inflate(gzip(""), 0), "");
}

TEST(RegionFile, IsNamedByItsPlace) {
    EXPECT_EQ(regionPosOf("r.-3.12.mca"), (RegionPos{-3, 12}));
    for (const char* name :
         {"r.1.mca", "r.1.2.mcc", "r..2.mca", "r.1.2x.mca", "1.2.mca", "r.mca", "", "r.99999999999.0.mca"})
        EXPECT_EQ(regionPosOf(name), std::nullopt) << name;
}

}  // namespace
}  // namespace terrane::formats
