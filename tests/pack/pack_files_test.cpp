#include "terrane/pack/pack_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zip.h>

#include "terrane/base/files.h"
#include "terrane/pack/content.h"
#include "terrane/pack/pack.h"
#include "tests/base/file_size_limit.h"
#include "tests/base/temp_folder.h"
#include "tests/pack/pack_fixture.h"

namespace terrane::pack {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

void writeFolder(const fs::path& folder, const PackFiles& files) {
    for (const auto& [path, data] : files) {
        fs::create_directories((folder / path).parent_path());
        ASSERT_TRUE(base::writeFile(folder / path, data));
    }
}

void writeZip(const fs::path& path, const PackFiles& files, const std::string& folder) {
    int code = 0;
    zip_t* zip = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code);
    ASSERT_NE(zip, nullptr);
    for (const auto& [name, data] : files) {
        zip_source_t* source = zip_source_buffer(zip, data.data(), data.size(), 0);
        ASSERT_GE(zip_file_add(zip, (folder + name).c_str(), source, ZIP_FL_OVERWRITE), 0);
    }
    ASSERT_EQ(zip_close(zip), 0);
}

class PackFilesTest : public testing::Test {
  protected:
    base::TempFolder temp_;
    fs::path folder_ = temp_.path();
    PackFiles files_ = glowFiles("isles");
};

TEST_F(PackFilesTest, AFolderAndAZipFileAreTheSame) {
    writeFolder(folder_ / "a", files_);
    writeZip(folder_ / "b.zip", files_, "");
    writeZip(folder_ / "c.zip", files_, "isles-1.2/");
    const PackHash hash = hashOf(packOfFiles(files_));
    for (const char* name : {"a", "b.zip", "c.zip"}) {
        const auto read = readPack(folder_ / name);
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(hashOf(*read), hash) << name;
    }
}

TEST_F(PackFilesTest, OtherFilesAreLeftOut) {
    PackFiles more = files_;
    more["README.md"] = "text";
    more["textures/Big Name.png"] = "x";
    more["textures/deep/stone.png"] = "x";
    more["generators/notes.txt"] = "x";
    writeFolder(folder_ / "a", more);
    writeZip(folder_ / "a.zip", more, "");
    EXPECT_EQ(readPack(folder_ / "a").value().files, files_);
    EXPECT_EQ(readPack(folder_ / "a.zip").value().files, files_);
}

TEST_F(PackFilesTest, FilesOutsideOfTheFolderAreNotReached) {
    PackFiles hostile = files_;
    hostile["../textures/evil.png"] = "x";
    hostile["/etc/passwd"] = "x";
    hostile["textures/../../evil.png"] = "x";
    writeZip(folder_ / "a.zip", hostile, "");
    EXPECT_EQ(readPack(folder_ / "a.zip").value().files, files_);
}

// 200 MiB of zeros in a few hundred kilobytes.
TEST_F(PackFilesTest, ABombIsStopped) {
    PackFiles bomb = files_;
    bomb["textures/zeros.png"] = std::string(std::size_t{65} << 20, '\0');
    writeZip(folder_ / "bomb.zip", bomb, "");
    EXPECT_LT(fs::file_size(folder_ / "bomb.zip"), 1'000'000u);
    const auto read = readPack(folder_ / "bomb.zip");
    ASSERT_FALSE(read);
    EXPECT_THAT(read.error().message, HasSubstr("the pack has more than 64 MiB"));
}

TEST_F(PackFilesTest, WhatIsNoPackIsSaid) {
    fs::create_directories(folder_ / "empty");
    EXPECT_THAT(readPack(folder_ / "empty").error().message, HasSubstr("there is no pack.toml"));
    ASSERT_TRUE(base::writeFile(folder_ / "text.zip", "no zip at all"));
    EXPECT_THAT(readPack(folder_ / "text.zip").error().message,
                HasSubstr("not a zip file of a content pack"));
    EXPECT_FALSE(readPack(folder_ / "nowhere"));
}

// Its nodes would take gigabytes.
TEST_F(PackFilesTest, ATableThatIsTooLargeIsNotParsed) {
    const auto pack = makePack({{"pack.toml", "a = [" + std::string(8 << 20, '[')}}, "p");
    ASSERT_FALSE(pack);
    EXPECT_EQ(pack.error().message, "p/pack.toml: more than 4096 KiB");
}

TEST_F(PackFilesTest, PacksAreFoundByNameOrPath) {
    writeFolder(folder_ / "isles", files_);
    writeZip(folder_ / "ores.zip", files_, "");
    const fs::path folders[] = {folder_};
    EXPECT_EQ(findPack("isles", folders).value(), folder_ / "isles");
    EXPECT_EQ(findPack("ores", folders).value(), folder_ / "ores.zip");
    EXPECT_EQ(findPack((folder_ / "isles").string(), {}).value(), folder_ / "isles");
    const auto missing = findPack("trees", folders);
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, base::ErrorCode::NotFound);
    EXPECT_THAT(missing.error().message, HasSubstr("\"trees\""));
    EXPECT_THAT(packsIn(folder_), testing::ElementsAre(folder_ / "isles", folder_ / "ores.zip"));
}

TEST_F(PackFilesTest, TheSkeletonWorks) {
    ASSERT_TRUE(writeSkeleton(folder_ / "mine"));
    auto pack = readPack(folder_ / "mine");
    ASSERT_TRUE(pack) << pack.error().message;
    EXPECT_EQ(pack->info.name, "mine");
    const auto content = loadContent({*pack});
    ASSERT_TRUE(content) << content.error().message;
    EXPECT_NE(content->blocks->find("mine:glow_rock"), nullptr);
    EXPECT_GT(gen::versionOf(content->generators, "mine:" + std::string(kSkeletonGenerator)), 0);
    EXPECT_FALSE(writeSkeleton(folder_ / "mine"));  // never over what is there
    EXPECT_FALSE(writeSkeleton(folder_ / "No Name"));
}

TEST_F(PackFilesTest, NoHalfOfASkeletonStays) {
    if (!base::FileSizeLimit::kWorks) GTEST_SKIP() << "this system has no limit of file sizes";
    {
        const base::FileSizeLimit full(100);
        EXPECT_FALSE(writeSkeleton(folder_ / "mine"));
    }
    EXPECT_FALSE(std::filesystem::exists(folder_ / "mine"));
    EXPECT_TRUE(writeSkeleton(folder_ / "mine"));
}

}  // namespace
}  // namespace terrane::pack
