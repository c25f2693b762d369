#include "terrane/io/area_files.h"

#include <gtest/gtest.h>

#include "terrane/base/files.h"
#include "tests/base/temp_folder.h"
#include "tests/support/default_heights.h"

namespace terrane::io {
namespace {

constexpr std::size_t kColumnBytes = world::kChunkHeight * sizeof(std::uint16_t);

TEST(VolumeFile, SquaresComeToTheirPlacesInAnyOrder) {
    const base::TempFolder folder;
    const world::ChunkArea area{-1, 0, 1, 2};
    auto file = VolumeFile::create(folder / "volume.npy", area, {});
    ASSERT_TRUE(file) << file.error().message;
    for (const world::ChunkArea& square : {world::ChunkArea{0, 0, 1, 2}, world::ChunkArea{-1, 0, 0, 2}}) {
        const auto written = file->write(square, [&](int x, int y, auto values) {
            values[0] = static_cast<std::uint16_t>((square.x0 + 1) * world::kChunkSize + x);
            values[1] = static_cast<std::uint16_t>(y);
        });
        ASSERT_TRUE(written) << written.error().message;
    }
    ASSERT_TRUE(file->finish());
    const std::string bytes = base::readFile(folder / "volume.npy").value();
    const std::size_t sideBlocks = 32, header = bytes.size() - sideBlocks * sideBlocks * kColumnBytes;
    EXPECT_NE(bytes.substr(0, header).find("(32, 32, 256)"), std::string::npos) << bytes.substr(0, header);
    const auto valueAt = [&](std::size_t x, std::size_t y, std::size_t z) {
        const std::size_t at = header + (x * sideBlocks + y) * kColumnBytes + 2 * z;
        return static_cast<std::uint8_t>(bytes[at]) | static_cast<std::uint8_t>(bytes[at + 1]) << 8;
    };
    for (const std::size_t x : {0u, 15u, 16u, 31u}) {
        EXPECT_EQ(valueAt(x, 20, 0), static_cast<int>(x));
        EXPECT_EQ(valueAt(x, 20, 1), 20);
    }
}

TEST(VolumeFile, AnAreaTooLargeForAnyFileIsRefused) {
    const base::TempFolder folder;
    EXPECT_FALSE(VolumeFile::create(folder / "volume.npy", {0, 0, 100'000'000, 100'000'000}, {}));
    EXPECT_EQ(folder.fileCount(), 0);
}

TEST(QuadFile, AFileWithoutQuadsIsWhole) {
    const base::TempFolder folder;
    auto file = QuadFile::create(folder / "quads.npy", {});
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_TRUE(file->finish());
    EXPECT_NE(base::readFile(folder / "quads.npy").value().find("(0,)"), std::string::npos);
}

}  // namespace
}  // namespace terrane::io
