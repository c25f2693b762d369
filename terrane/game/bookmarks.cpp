#include "terrane/game/bookmarks.h"

#include <fstream>
#include <sstream>
#include <string>

#include "terrane/base/files.h"
#include "terrane/base/log.h"
#include "terrane/game/pose_text.h"

namespace terrane::game {
namespace {

base::Result<void> readInto(std::vector<world::Pose>& bookmarks, const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return {};
    const auto text = TERRANE_TRY(base::readFile(file));
    std::istringstream in(text);
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        const auto pose = poseFrom(line);
        if (!pose)
            return base::fail("{}:{}: expected x y z yaw pitch, got {:?}", file.string(), number, line);
        bookmarks.push_back(*pose);
    }
    return {};
}

// True if, for example, the program runs in its data folder.
bool isSameFile(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code ignored;
    return std::filesystem::equivalent(a, b, ignored);
}

}  // namespace

BookmarkFiles bookmarkFiles(const std::filesystem::path& dataFolder) {
    return {dataFolder / "bookmarks.txt", {"positions.txt", "bookmarks.txt"}};
}

void reportFormerFiles(const BookmarkFiles& files) {
    std::error_code ignored;
    for (const std::filesystem::path& former : files.former)
        if (std::filesystem::exists(former, ignored) && !isSameFile(former, files.file))
            base::logInfo("{}: its bookmarks are read from the working directory; new ones go to {}",
                          former.string(), files.file.string());
}

base::Result<std::vector<world::Pose>> readBookmarks(const BookmarkFiles& files) {
    std::vector<world::Pose> bookmarks;
    for (const std::filesystem::path& former : files.former) {
        if (isSameFile(former, files.file)) continue;
        TERRANE_TRY(readInto(bookmarks, former));
    }
    TERRANE_TRY(readInto(bookmarks, files.file));
    return bookmarks;
}

base::Result<void> appendBookmark(const std::filesystem::path& file, const world::Pose& pose) {
    std::error_code error;
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), error);
    std::ofstream out(file, std::ios::app);
    out << textOf(pose) << '\n';
    out.flush();
    if (!out) return base::fail("{}: cannot be written", file.string());
    return {};
}

}  // namespace terrane::game
