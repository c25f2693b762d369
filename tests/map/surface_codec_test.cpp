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
    // Steps at which the prediction leaves 0…255.
    Columns steps(kColumnsOfBlob);
    for (std::size_t k = 0; k < steps.size(); ++k) {
        steps[k] = {static_cast<world::BlockId>(k), static_cast<world::BlockId>(~k),
                    static_cast<std::uint8_t>(k % 3 == 0 ? 255 : 0),
                    static_cast<std::uint8_t>(k / 256 % 2 * 255)};
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
        0xaa, 0xcd, 0xae, 0x68, 0x29, 0x5c, 0x87, 0x45, 0x28, 0xb5, 0x2f, 0xfd, 0x00, 0x48, 0xfc, 0x00,
        0x00, 0x68, 0xc8, 0x92, 0x00, 0x92, 0x00, 0x5a, 0x00, 0x5a, 0xa6, 0x00, 0x0a, 0x00, 0x0a, 0x05,
        0x10, 0x00, 0xfa, 0x7e, 0x1d, 0xf9, 0x14, 0xd3, 0xef, 0xeb, 0x4e, 0x4f, 0x65, 0x3d, 0x35, 0x04,
        0x94, 0x00, 0x00, 0x28, 0x05, 0x03, 0x00, 0x03, 0x00, 0x03, 0x10, 0x00, 0xfc, 0x7f, 0x5d, 0xe8,
        0xfb, 0x75, 0xcc, 0xa7, 0xb0, 0xb5, 0x00, 0x00, 0x40, 0x00, 0x31, 0x00, 0x31, 0x00, 0x12, 0x00,
        0x12, 0x04, 0x50, 0x02, 0x00, 0xfa, 0x7e, 0x9d, 0x4f, 0xe9, 0xfb, 0x75, 0x3e, 0x15};
    Columns expected(kColumnsOfBlob, {3, 0x1234, 90, 80});
    expected[0] = {5, 5, 200, 200};
    expected[257] = {0, 0, 0, 0};
    const auto decoded = decodeSurfaces(std::as_bytes(std::span(kRow)));
    ASSERT_TRUE(decoded) << decoded.error().message;
    EXPECT_TRUE(*decoded == expected);
}

}  // namespace
}  // namespace terrane::map
