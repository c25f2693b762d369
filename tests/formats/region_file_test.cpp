#include "terrane/formats/region_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

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
    EXPECT_THAT(regionError(readRegionChunk(regionWith(5, 4, data), 5, {})), HasSubstr("LZ4"));
    EXPECT_THAT(regionError(readRegionChunk(regionWith(5, 127, data), 5, {})), HasSubstr("compression 127"));
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
