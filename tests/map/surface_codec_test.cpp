#include "terrane/map/surface_cache.h"

#include "tests/map/map_fixture.h"

namespace terrane::map {
namespace {

using Columns = std::vector<SurfaceColumn>;

// The generator's columns from chunk 16 x, 16 y on.
Columns generatedColumns(int level) {
    Columns columns(kColumnsOfBlob);
    for (int chunk = 0; chunk < 256; ++chunk) {
        const int x = chunk % 16, y = chunk / 16;
        const Surface surface =
            generatedSurface(generatorsOf("overworld"), {x - 16, y, static_cast<std::uint8_t>(level)});
        for (int k = 0; k < 256; ++k)
            columns[static_cast<std::size_t>((y * 16 + k / 16) * kBlobColumns + x * 16 + k % 16)] =
                surface[static_cast<std::size_t>(k)];
    }
    return columns;
}

void expectReadsBack(const Columns& columns) {
    const auto decoded = decodeSurfaces(encodeSurfaces(columns));
    ASSERT_TRUE(decoded) << decoded.error().message;
    EXPECT_TRUE(*decoded == columns);
}

TEST(SurfaceCodec, AnyColumnsReadBack) {
    std::mt19937 random(1);
    for (int round = 0; round < 3; ++round) {
        Columns columns(kColumnsOfBlob);
        for (SurfaceColumn& column : columns) column = randomColumn(random);
        expectReadsBack(columns);
    }
    expectReadsBack(Columns(kColumnsOfBlob));
    expectReadsBack(Columns(kColumnsOfBlob, {0xFFFF, 0, 255, 0}));
    // Steps at which the prediction leaves all heights.
    Columns steps(kColumnsOfBlob);
    for (std::size_t k = 0; k < steps.size(); ++k) {
        steps[k] = {static_cast<world::BlockId>(k), static_cast<world::BlockId>(~k),
                    static_cast<std::int16_t>(k % 3 == 0 ? world::kHighestTop - 1 : world::kLowestBottom),
                    static_cast<std::int16_t>(k / 256 % 2 * 255)};
    }
    expectReadsBack(steps);
}

TEST(SurfaceCodec, LandTakesLessThanAByteAColumn) {
    for (const int level : {0, 4}) {
        const Columns columns = generatedColumns(level);
        expectReadsBack(columns);
        // From afar neighbors differ more.
        EXPECT_LT(encodeSurfaces(columns).size(), level == 0 ? kColumnsOfBlob : kColumnsOfBlob * 3 / 2);
    }
}

store::Bytes sparseBlob() {
    std::mt19937 random(2);
    Columns columns(kColumnsOfBlob, {7, 7, 80, 80});
    for (int k = 0; k < 300; ++k) columns[random() % columns.size()] = randomColumn(random);
    return encodeSurfaces(columns);
}

TEST(SurfaceCodec, EveryLengthThatIsCutIsAnError) {
    const store::Bytes whole = sparseBlob();
    ASSERT_TRUE(decodeSurfaces(whole));
    for (std::size_t size = 0; size < whole.size(); size += size < 40 ? 1 : 97) {
        const auto decoded = decodeSurfaces(store::ByteView(whole).first(size));
        ASSERT_FALSE(decoded) << size;
        EXPECT_EQ(decoded.error().code, base::ErrorCode::Damaged);
        EXPECT_FALSE(decoded.error().message.empty());
    }
}

TEST(SurfaceCodec, AChangedByteIsAnError) {
    const store::Bytes whole = sparseBlob();
    std::mt19937 random(3);
    for (int round = 0; round < 100; ++round) {
        store::Bytes bytes = whole;
        const std::size_t at = random() % bytes.size();
        bytes[at] ^= static_cast<std::byte>(1u << random() % 8);
        // Some bits of a frame's header mean nothing.
        const auto decoded = decodeSurfaces(bytes);
        EXPECT_TRUE(!decoded || *decoded == *decodeSurfaces(whole)) << "byte " << at;
        EXPECT_FALSE(at < 8 && decoded) << "the checksum";
    }
}

TEST(SurfaceCodec, BytesThatFollowAreAnError) {
    store::Bytes bytes = sparseBlob();
    bytes.push_back(std::byte{0});
    EXPECT_FALSE(decodeSurfaces(bytes));
}

// Files of older builds are read as long as the form of rows is the same: a change here needs another kForm
// in surface_cache.cpp.
TEST(SurfaceCodec, RowsOfFormerBuildsAreRead) {
    constexpr std::uint8_t kRow[] = {
        0x4f, 0x19, 0x43, 0xe8, 0x79, 0x0c, 0x7d, 0x7c, 0x28, 0xb5, 0x2f, 0xfd, 0x00, 0x48, 0xb4, 0x01,
        0x00, 0xe0, 0xc8, 0x92, 0x00, 0x92, 0x14, 0x5a, 0x00, 0x12, 0xee, 0x00, 0x5a, 0xa6, 0x00, 0xee,
        0x12, 0x00, 0xff, 0x00, 0xff, 0x00, 0x07, 0xf8, 0x00, 0xff, 0x00, 0xf8, 0x07, 0x00, 0x0a, 0x10,
        0x00, 0xce, 0x7d, 0x7d, 0x2c, 0x31, 0x94, 0x1a, 0x21, 0xac, 0xa7, 0xf0, 0x73, 0x5f, 0x1f, 0xcb,
        0xf1, 0xa4, 0xc6, 0x92, 0xe8, 0xa9, 0x21, 0xd4, 0x00, 0x00, 0x48, 0x00, 0x0a, 0x00, 0x0a, 0x74,
        0x0a, 0x00, 0x0e, 0x00, 0x05, 0x10, 0x00, 0xcf, 0x7e, 0x1d, 0x51, 0x54, 0xf6, 0xec, 0xd7, 0x1b,
        0xa8, 0xf1, 0xa9, 0x36, 0xb4, 0x00, 0x00, 0x38, 0x05, 0x03, 0x00, 0x03, 0x07, 0x03, 0x00, 0x04,
        0x10, 0x00, 0xfc, 0x7f, 0x5d, 0x3c, 0xfb, 0x75, 0x0c, 0xc2, 0x7c, 0x0a, 0x0b, 0xe5, 0x00, 0x00,
        0x60, 0x00, 0x31, 0x00, 0x31, 0x01, 0x31, 0x00, 0x12, 0x00, 0x12, 0x00, 0x12, 0x06, 0x50, 0x02,
        0x00, 0xcf, 0x7e, 0x1d, 0xc4, 0xa7, 0x9e, 0xfd, 0x3a, 0x88, 0x4f, 0x05};
    Columns expected(kColumnsOfBlob, {3, 0x1234, 90, 80});
    expected[0] = {5, 5, 200, 200};
    expected[257] = {0, 0, 0, 0};
    expected[300] = {7, 8, 1900, -1800};
    const auto decoded = decodeSurfaces(std::as_bytes(std::span(kRow)));
    ASSERT_TRUE(decoded) << decoded.error().message;
    EXPECT_TRUE(*decoded == expected);
}

}  // namespace
}  // namespace terrane::map
