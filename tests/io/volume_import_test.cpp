// Models that are imported and exported again.
#include "terrane/io/volume_import.h"

#include <gtest/gtest.h>

#include "terrane/base/files.h"
#include "terrane/formats/vox_file.h"
#include "terrane/io/export_formats.h"
#include "terrane/store/chunks/structure_file.h"
#include "tests/io/flat_world.h"

namespace terrane::io {
namespace {

constexpr int kSide = 20;                      // more than a chunk
constexpr world::BlockPos kCorner{-4, 5, 90};  // above the land

class VolumeImport : public testing::Test {
  protected:
    void SetUp() override {
        formats::VoxImage model{
            .size = {kSide, kSide, 1}, .colors = {}, .cells = std::vector<std::uint8_t>(kSide * kSide, 1)};
        model.colors[1] = 0x808080FF;
        model.cells[0] = 0;
        ASSERT_TRUE(base::writeFile(folder_ / "model.vox", formats::encodeVox(model)));
    }
    ImportOptions options() { return {folder_ / "model.vox", flatLand(), worldIn(folder_), ""}; }
    base::Result<ExportSource> exported() {
        ExportOptions from{
            flatLand(), worldIn(folder_),
            world::BlockBox{kCorner, {kCorner.x + kSide - 1, kCorner.y + kSide - 1, kCorner.z}}, ""};
        return openExport(from);
    }

    base::TempFolder folder_;
    VolumeOptions volume_{VolumeFormat::Vox, kCorner};
};

TEST_F(VolumeImport, ComesToItsPlace) {
    ImportOptions from = options();
    std::size_t last = 0, all = 0;
    const auto report = importVolume(from, volume_, [&](std::size_t done, std::size_t total) {
        EXPECT_GE(done, last);
        last = done;
        all = total;
        return true;
    });
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->chunks, 4u);
    EXPECT_EQ(last, 4u);
    EXPECT_EQ(all, 4u);
    const auto source = exported();
    ASSERT_TRUE(source) << source.error().message;
    const auto volume = readVolume(*source);
    ASSERT_TRUE(volume) << volume.error().message;
    ASSERT_EQ(volume->cells.size(), std::size_t{kSide * kSide});
    EXPECT_EQ(volume->palette[volume->cells[0]].id, world::kAir);
    for (std::size_t k = 1; k < volume->cells.size(); ++k)
        EXPECT_NE(volume->palette[volume->cells[k]].id, world::kAir) << k;
}

TEST_F(VolumeImport, StopsWhenAsked) {
    ImportOptions from = options();
    const auto report = importVolume(from, volume_, [](std::size_t, std::size_t) { return false; });
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().message, "stopped after 0 of 4 chunks");
}

TEST_F(VolumeImport, NeedsAWorld) {
    ImportOptions from = options();
    from.save = {};
    EXPECT_FALSE(importVolume(from, volume_));
}

TEST_F(VolumeImport, BecomesAStructure) {
    const auto imported = importStructure(options(), VolumeFormat::Vox);
    ASSERT_TRUE(imported) << imported.error().message;
    EXPECT_TRUE(store::decodeStructure(imported->bytes));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "world.sqlite"));
}

TEST_F(VolumeImport, AllExportsWriteTheirFiles) {
    ImportOptions from = options();
    ASSERT_TRUE(importVolume(from, volume_));
    const auto source = exported();
    ASSERT_TRUE(source) << source.error().message;
    const base::Result<ExportedFile> files[] = {
        exportGlb(*source, folder_ / "a.glb"),        exportSchematic(*source, folder_ / "a.schem", ""),
        exportVox(*source, folder_ / "a.vox"),        exportNpy(*source, folder_ / "a.npy"),
        exportNpyHeights(*source, folder_ / "h.npy"), exportPngHeights(*source, folder_ / "h.png", 16),
    };
    const char* const names[] = {"a.glb", "a.schem", "a.vox", "a.npy", "h.npy", "h.png"};
    for (std::size_t k = 0; k < std::size(names); ++k) {
        ASSERT_TRUE(files[k]) << names[k] << ": " << files[k].error().message;
        EXPECT_EQ(files[k]->bytes, std::filesystem::file_size(folder_ / names[k])) << names[k];
    }
    EXPECT_EQ(files[3]->content, "20×20×1 blocks");
    EXPECT_EQ(files[4]->content, "20×20 columns");
    EXPECT_TRUE(std::filesystem::exists(folder_ / "a.npy.names.json"));
}

}  // namespace
}  // namespace terrane::io
