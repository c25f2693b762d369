#include "terrane/base/files.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "tests/base/file_size_limit.h"
#include "tests/base/temp_folder.h"

namespace terrane::base {
namespace {

TEST(Files, RoundTripAnyBytes) {
    const TempFolder folder;
    std::string bytes;
    for (int i = 0; i < 200000; ++i) bytes += static_cast<char>(i % 251);
    for (const std::string& content : {std::string(), std::string("a\0\r\n", 4), bytes}) {
        ASSERT_TRUE(writeFile(folder / "file", content));
        const Result<std::string> result = readFile(folder / "file");
        ASSERT_TRUE(result);
        EXPECT_EQ(*result, content);
    }
    EXPECT_EQ(folder.fileCount(), 1) << "no temporary file stays";
}

TEST(Files, ReadingAMissingFileNamesPathAndReason) {
    const Result<std::string> result = readFile("no/such/file.txt");
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().message, "no/such/file.txt: cannot be read: No such file or directory");
}

TEST(Files, ReadingAFolderIsAnError) {
    const TempFolder folder;
    const Result<std::string> result = readFile(folder.path());
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().message, folder.path().string() + ": cannot be read: Is a directory");
}

TEST(Files, LargeFilesAreRefused) {
    const TempFolder folder;
    ASSERT_TRUE(writeFile(folder / "large", ""));
    std::filesystem::resize_file(folder / "large", std::uintmax_t{20} << 30);  // a sparse file
    EXPECT_EQ(readFile(folder / "large").error().message,
              (folder / "large").string() + ": cannot be read: it has more than 67108864 bytes");
    ASSERT_TRUE(writeFile(folder / "small", "12345"));
    EXPECT_FALSE(readFile(folder / "small", 4));
    EXPECT_EQ(readFile(folder / "small", 5), "12345");
}

TEST(Files, WritingIntoAMissingFolderNamesPathAndReason) {
    const TempFolder folder;
    const std::filesystem::path path = folder / "missing" / "a.txt";
    const Result<void> result = writeFile(path, "a");
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().message, path.string() + ": cannot be written: No such file or directory");
    EXPECT_FALSE(std::filesystem::exists(folder / "missing")) << "no folder is made";
}

TEST(Files, WritingOverAFolderIsAnError) {
    const TempFolder folder;
    std::filesystem::create_directory(folder / "inner");
    const Result<void> result = writeFile(folder / "inner", "a");
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().message, (folder / "inner").string() + ": cannot be written: Is a directory");
    EXPECT_EQ(folder.fileCount(), 1);
}

TEST(Files, AFailedWriteLeavesTheOldFileAndNoTemporaryOne) {
    if (!FileSizeLimit::kWorks) GTEST_SKIP() << "this system has no limit of file sizes";
    const TempFolder folder;
    ASSERT_TRUE(writeFile(folder / "file", "old"));
    Result<void> result;
    {
        const FileSizeLimit limit(1000);
        result = writeFile(folder / "file", std::string(100000, 'x'));
    }
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().message, (folder / "file").string() + ": cannot be written: File too large");
    EXPECT_EQ(readFile(folder / "file").value(), "old");
    EXPECT_EQ(folder.fileCount(), 1);
}

TEST(Files, SeveralFilesAreWrittenAllOrNone) {
    if (!FileSizeLimit::kWorks) GTEST_SKIP() << "this system has no limit of file sizes";
    const TempFolder folder;
    const std::string large(100000, 'x');
    const std::vector<FileToWrite> files{{folder / "small", "new"}, {folder / "large", large}};
    ASSERT_TRUE(writeFile(folder / "small", "old"));
    {
        const FileSizeLimit limit(1000);
        const Result<void> result = writeFiles(files);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().message,
                  (folder / "large").string() + ": cannot be written: File too large");
    }
    EXPECT_EQ(readFile(folder / "small").value(), "old");
    EXPECT_EQ(folder.fileCount(), 1);
    ASSERT_TRUE(writeFiles(files));
    EXPECT_EQ(readFile(folder / "small").value(), "new");
    EXPECT_EQ(readFile(folder / "large").value(), large);
    EXPECT_EQ(folder.fileCount(), 2);
    EXPECT_FALSE(writeFiles(std::vector<FileToWrite>{{folder / "third", "x"}, {folder / "no/folder", "x"}}));
    EXPECT_EQ(folder.fileCount(), 2);
}

#ifndef _WIN32  // whose C++ library makes no links

TEST(Files, LinksAreFollowed) {
    const TempFolder folder;
    std::filesystem::create_directory(folder / "inner");
    ASSERT_TRUE(writeFile(folder / "inner/target", "old"));
    std::filesystem::create_symlink("inner/target", folder / "link");
    std::filesystem::create_symlink("link", folder / "link to a link");
    ASSERT_TRUE(writeFile(folder / "link to a link", "new"));
    EXPECT_EQ(readFile(folder / "inner/target").value(), "new");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link to a link"));
    EXPECT_EQ(folder.fileCount(), 3);
}

TEST(Files, WhatALinkLeadsToIsMade) {
    const TempFolder folder;
    std::filesystem::create_directory(folder / "inner");
    std::filesystem::create_symlink("inner/target", folder / "link");
    ASSERT_TRUE(writeFile(folder / "link", "new"));
    EXPECT_EQ(readFile(folder / "inner/target").value(), "new");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_FALSE(std::filesystem::is_symlink(folder / "inner/target"));
    EXPECT_EQ(folder.fileCount(), 2);
}

TEST(Files, LinksThatLeadNowhereAreAnError) {
    const TempFolder folder;
    std::filesystem::create_symlink("no folder/target", folder / "link");
    std::filesystem::create_symlink("circle", folder / "circle");
    const Result<void> nowhere = writeFile(folder / "link", "a");
    ASSERT_FALSE(nowhere);
    EXPECT_EQ(nowhere.error().message,
              (folder / "no folder/target").string() + ": cannot be written: No such file or directory");
    const Result<void> circle = writeFile(folder / "circle", "a");
    ASSERT_FALSE(circle);
    EXPECT_EQ(circle.error().message,
              (folder / "circle").string() + ": cannot be written: Too many levels of symbolic links");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(folder.fileCount(), 2);
}

#endif

TEST(Files, LeftoversOfACrashAreSteppedOver) {
    const TempFolder folder;
    ASSERT_TRUE(writeFile(folder / "file.tmp0", "half"));
    ASSERT_TRUE(writeFile(folder / "file", "new"));
    EXPECT_EQ(readFile(folder / "file").value(), "new");
    EXPECT_EQ(readFile(folder / "file.tmp0").value(), "half");
}

TEST(Files, WritersOfOnePathNeverMix) {
    const TempFolder folder;
    const std::string first(100000, 'a');
    const std::string second(100000, 'b');
    std::vector<std::thread> threads;
    for (const std::string& content : {first, second, first, second}) {
        threads.emplace_back([&, content] {
            for (int i = 0; i < 25; ++i) {
                EXPECT_TRUE(writeFile(folder / "file", content));
                const std::string seen = readFile(folder / "file").value();
                EXPECT_TRUE(seen == first || seen == second);
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(folder.fileCount(), 1);
}

}  // namespace
}  // namespace terrane::base
