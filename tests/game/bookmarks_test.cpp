#include "terrane/game/places.h"

#include <gtest/gtest.h>

#include <fstream>

#include "terrane/game/player_state.h"
#include "tests/base/temp_folder.h"

namespace terrane::game {
namespace {

class Bookmarks : public testing::Test {
  protected:
    void write(std::string_view text) { std::ofstream(former_) << text; }

    base::TempFolder folder_;
    std::filesystem::path file_ = folder_.path() / "data" / "bookmarks.txt";
    std::filesystem::path former_ = folder_.path() / "positions.txt";
    BookmarkFiles files_{file_, {former_}};
};

TEST_F(Bookmarks, ComeBackAsTheyWere) {
    const world::Pose pose{{-2147483000.25, 0.1, 77.62}, -179.5f, 89.9f};
    EXPECT_EQ(parsePose(textOf(pose)), pose);
}

TEST_F(Bookmarks, WhatIsNoBookmarkIsNone) {
    for (const char* text :
         {"", "1 2 3 4", "1 2 3 4 5 6", "1 2 3 4 five", "nan 2 3 4 5", "1 2 inf 4 5", "1 2 3 nan 5",
          "1 2 3 4 nan", "1 2 3 4 91", "3000000000 2 3 4 5", "1 -3000000000 3 4 5", "1 2 3 4 5;"}) {
        EXPECT_FALSE(parsePose(text)) << text;
    }
}

TEST_F(Bookmarks, NoFileHasNone) {
    const auto bookmarks = readBookmarks(files_);
    ASSERT_TRUE(bookmarks);
    EXPECT_TRUE(bookmarks->empty());
}

TEST_F(Bookmarks, AreAppendedLineByLine) {
    for (const double x : {1.0, 2.5}) ASSERT_TRUE(appendBookmark(file_, {{x, 3, 4}, 5, 6}));
    const auto bookmarks = readBookmarks(files_);
    ASSERT_TRUE(bookmarks) << bookmarks.error().message;
    ASSERT_EQ(bookmarks->size(), 2u);
    EXPECT_EQ((*bookmarks)[1].position, glm::dvec3(2.5, 3, 4));
}

TEST_F(Bookmarks, TheFileOfTheFormerNameIsRead) {
    write("1 2 3 4 5\n");
    ASSERT_TRUE(appendBookmark(file_, {{6, 7, 8}, 9, 10}));
    const auto bookmarks = readBookmarks(files_);
    ASSERT_TRUE(bookmarks) << bookmarks.error().message;
    ASSERT_EQ(bookmarks->size(), 2u);
    EXPECT_EQ((*bookmarks)[0].position, glm::dvec3(1, 2, 3))
        << "it comes first: bookmarks keep their numbers";
}

TEST_F(Bookmarks, OneFileIsReadOnce) {
    ASSERT_TRUE(appendBookmark(file_, {{1, 2, 3}, 4, 5}));
    files_.legacy = {file_.parent_path() / "." / file_.filename()};
    EXPECT_EQ(readBookmarks(files_).value().size(), 1u);
}

TEST_F(Bookmarks, AWrongLineIsNamed) {
    write("1 2 3 4 5\n\n1 2 3\n");
    const auto bookmarks = readBookmarks(files_);
    ASSERT_FALSE(bookmarks);
    EXPECT_EQ(bookmarks.error().message, former_.string() + ":3: expected x y z yaw pitch, got \"1 2 3\"");
}

TEST_F(Bookmarks, AFileThatCannotBeWrittenIsNamed) {
    std::ofstream(folder_.path() / "file") << "no folder";
    const auto done = appendBookmark(folder_.path() / "file" / "positions.txt", {});
    ASSERT_FALSE(done);
    EXPECT_NE(done.error().message.find("cannot be written"), std::string::npos);
}

}  // namespace
}  // namespace terrane::game
