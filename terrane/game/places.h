// Named places of a world, such as "home", stored in the world's metadata. Plain values.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/store/chunk_store.h"
#include "terrane/world/pose.h"

namespace terrane::game {

struct Place {
    std::string name;  // one line, 1 to kMaxPlaceName bytes
    world::Pose pose;

    bool operator==(const Place&) const = default;
};

constexpr std::size_t kMaxPlaces = 200, kMaxPlaceName = 60;

// One line for each place, "X Y Z YAW PITCH NAME".
std::string textOf(const std::vector<Place>& places);
// Parses a line; the name may be missing. Nothing if the line is invalid.
std::optional<Place> placeFrom(const std::string& line);
// Skips lines that are no place or have no name, and those beyond kMaxPlaces places.
std::vector<Place> placesFrom(std::string_view text);

// The typed text with control characters as spaces and without spaces at its ends, cut to kMaxPlaceName bytes
// between characters.
std::string placeName(std::string_view typed);
// Adds a place with the typed name; a place of the same name moves there. An error, one line for the player,
// if the name breaks the rule of base/names.h or looks like that of another place, or if there are kMaxPlaces
// already.
[[nodiscard]] base::Result<void> namePlace(std::vector<Place>& places, std::string_view typed,
                                           const world::Pose& pose);
// The name of a place for namePlace(): one of `places`, or a new one by that rule.
[[nodiscard]] base::Result<std::string> namedPlace(const std::vector<Place>& places, std::string_view typed);
// Adds a place that has its name, or moves it. False if there are kMaxPlaces already or the name is empty.
bool putPlace(std::vector<Place>& places, std::string_view name, const world::Pose& pose);

// The key in the store's metadata.
inline constexpr const char* kPlacesMetadata = "places";
std::vector<Place> savedPlaces(store::ReadableStore& store);
store::SaveNumber savePlaces(store::ChunkStore& store, const std::vector<Place>& places);

// The compass angle of a horizontal direction: degrees from north toward east, 0…360. The sun rises in the
// east, which is -x; north is -y.
double compassDegrees(double x, double y);
double compassDegrees(float yaw);

// A player's bookmarks: a text file with one pose a line. Called on one thread.
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
