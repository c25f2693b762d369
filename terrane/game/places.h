// Named places of a world, such as "home", stored in the world's metadata. All are plain values.
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

// Returns one line for each place, "X Y Z YAW PITCH NAME".
std::string textOf(const std::vector<Place>& places);
// Parses a line; the name may be missing. Returns nothing if the line is invalid.
std::optional<Place> placeFrom(const std::string& line);
// Parses lines. It skips lines that are no place or have no name, and lines beyond kMaxPlaces places.
std::vector<Place> placesFrom(std::string_view text);

// Returns the typed text with control characters as spaces and without spaces at its ends, cut to
// kMaxPlaceName bytes between characters.
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

// Returns the compass angle of a horizontal direction: degrees from north toward east, 0…360. The sun rises
// in the east, which is -x; north is -y.
double compassDegrees(double x, double y);
double compassDegrees(float yaw);

// Returns the distance in blocks, height included: a place may be 1,000 blocks above.
double distanceBetween(const world::Pose& from, const world::Pose& to);

// A player's bookmarks: a text file with one pose a line. It is called on one thread.
struct BookmarkFiles {
    std::filesystem::path file;                 // where new ones are appended
    std::vector<std::filesystem::path> legacy;  // where earlier versions wrote them
};

// Returns bookmarks.txt in `dataFolder`, and the files of versions before 0.2: positions.txt and
// bookmarks.txt in the working directory.
BookmarkFiles bookmarkFiles(const std::filesystem::path& dataFolder);

// Logs which legacy files exist.
void reportLegacyFiles(const BookmarkFiles& files);

// Returns the bookmarks of all files, legacy ones first, so that their numbers stay the same; missing files
// have none. An error names the first invalid line.
[[nodiscard]] base::Result<std::vector<world::Pose>> readBookmarks(const BookmarkFiles& files);
// Creates the file and its folder if needed.
[[nodiscard]] base::Result<void> appendBookmark(const std::filesystem::path& file, const world::Pose& pose);

}  // namespace terrane::game
