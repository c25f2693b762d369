#include "terrane/base/output_file.h"

#include <gtest/gtest.h>
#ifndef _WIN32
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

#include <filesystem>
#include <string>

#include "terrane/base/files.h"
#include "tests/base/file_size_limit.h"
#include "tests/base/temp_folder.h"

namespace terrane::base {
namespace {

TEST(OutputFile, PiecesMayComeInAnyOrder) {
    const TempFolder folder;
    auto file = OutputFile::create(folder / "file");
    ASSERT_TRUE(file);
    EXPECT_TRUE(file->write(6, "last"));
    EXPECT_TRUE(file->write(0, "one"));
    EXPECT_FALSE(std::filesystem::exists(folder / "file")) << "not before it is finished";
    EXPECT_TRUE(file->finish());
    EXPECT_EQ(readFile(folder / "file").value(), std::string("one\0\0\0last", 10));
    EXPECT_EQ(folder.fileCount(), 1);
}

#ifndef _WIN32  // rights of files are not modes

TEST(OutputFile, WhatIsReplacedKeepsItsMode) {
    const TempFolder folder;
    const auto path = folder / "a.txt";
    ASSERT_TRUE(writeFile(path, "one"));
    std::filesystem::permissions(path,
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    ASSERT_TRUE(writeFile(path, "two"));
    EXPECT_EQ(std::filesystem::status(path).permissions(),
              std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

#endif

TEST(OutputFile, OfAnUnfinishedOneNothingStays) {
    const TempFolder folder;
    ASSERT_TRUE(writeFile(folder / "file", "old"));
    {
        auto file = OutputFile::create(folder / "file");
        ASSERT_TRUE(file);
        EXPECT_TRUE(file->write(0, "new"));
        const OutputFile moved = std::move(*file);
        EXPECT_EQ(readFile(folder / "file").value(), "old");
    }
    EXPECT_EQ(readFile(folder / "file").value(), "old");
    EXPECT_EQ(folder.fileCount(), 1);
}

#ifndef _WIN32  // a file with a temporary name stays there

// The process ends without finish(), as when it is killed.
TEST(OutputFile, OfAProgramThatEndsMidwayNothingStays) {
    const TempFolder folder;
    const int unnamed = ::open((folder / ".").c_str(), O_TMPFILE | O_WRONLY, 0600);
    if (unnamed < 0) GTEST_SKIP() << "this file system has no files without a name";
    ::close(unnamed);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        auto file = OutputFile::create(folder / "file");
        ::_exit(file && file->write(0, "half") ? 0 : 1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    EXPECT_EQ(folder.fileCount(), 0);
}

#endif

TEST(OutputFile, OfAFullDiskNothingStays) {
    if (!FileSizeLimit::kWorks) GTEST_SKIP() << "this system has no limit of file sizes";
    const TempFolder folder;
    {
        auto file = OutputFile::create(folder / "file");
        ASSERT_TRUE(file);
        const FileSizeLimit limit(1000);
        EXPECT_TRUE(file->write(0, std::string(1000, 'x')));
        const auto more = file->write(1000, "x");
        ASSERT_FALSE(more);
        EXPECT_EQ(more.error().message, (folder / "file").string() + ": cannot be written: File too large");
    }
    EXPECT_EQ(folder.fileCount(), 0);
}

TEST(OutputFile, WhatDoesNotFitTheDiskIsToldAtOnce) {
    if (!FileSizeLimit::kWorks) GTEST_SKIP() << "this system has no limit of file sizes";
    const TempFolder folder;
    auto file = OutputFile::create(folder / "file");
    ASSERT_TRUE(file);
    EXPECT_TRUE(file->reserve(0));
    EXPECT_TRUE(file->reserve(1 << 16));
    const FileSizeLimit limit(1 << 20);
    for (const std::uint64_t size : {std::uint64_t{1} << 30, std::uint64_t{1} << 60, ~std::uint64_t{0}}) {
        const auto reserved = file->reserve(size);
        ASSERT_FALSE(reserved) << size;
        EXPECT_EQ(reserved.error().code, ErrorCode::OutOfResources);
        EXPECT_EQ(reserved.error().message.find((folder / "file").string() + ": " + std::to_string(size) +
                                                " bytes do not fit: "),
                  0u)
            << reserved.error().message;
    }
}

}  // namespace
}  // namespace terrane::base
