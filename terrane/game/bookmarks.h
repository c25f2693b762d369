// A player's bookmarks: a text file with one pose a line. Called on one thread.
#pragma once

#include <filesystem>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/world/pose.h"

namespace terrane::game {

struct BookmarkFiles {
    std::filesystem::path file;                 // where new ones are appended
    std::vector<std::filesystem::path> former;  // where earlier versions wrote them
};

// bookmarks.txt in `dataFolder`; before version 0.2 positions.txt and bookmarks.txt in the working directory.
BookmarkFiles bookmarkFiles(const std::filesystem::path& dataFolder);

// Logs which former files exist.
void reportFormerFiles(const BookmarkFiles& files);

// The bookmarks of all files, former ones first, so that they keep their numbers; missing files have none. An
// error names the first invalid line.
[[nodiscard]] base::Result<std::vector<world::Pose>> readBookmarks(const BookmarkFiles& files);
// Creates the file and its folder if needed.
[[nodiscard]] base::Result<void> appendBookmark(const std::filesystem::path& file, const world::Pose& pose);

}  // namespace terrane::game
