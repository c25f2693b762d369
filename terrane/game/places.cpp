#include "terrane/game/places.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "terrane/base/files.h"
#include "terrane/base/log.h"
#include "terrane/base/names.h"
#include "terrane/game/player_state.h"

namespace terrane::game {

namespace {

constexpr int kPoseNumbers = 5;

bool isContinuation(char c) {
    return (static_cast<unsigned char>(c) & 0xC0) == 0x80;  // of a character in UTF-8
}

}  // namespace

std::optional<Place> placeFrom(const std::string& line) {
    std::istringstream in(line);
    std::string pose, number, name;
    for (int k = 0; k < kPoseNumbers && in >> number; ++k) pose += (k == 0 ? "" : " ") + number;
    std::getline(in >> std::ws, name);
    const auto at = parsePose(pose);
    if (!at || placeName(name) != name) return std::nullopt;
    return Place{name, *at};
}

std::string textOf(const std::vector<Place>& places) {
    std::string text;
    for (const Place& place : places) text += textOf(place.pose) + " " + place.name + "\n";
    return text;
}

std::vector<Place> placesFrom(std::string_view text) {
    std::vector<Place> places;
    std::istringstream in{std::string(text)};
    for (std::string line; places.size() < kMaxPlaces && std::getline(in, line);)
        if (auto place = placeFrom(line); place && !place->name.empty()) places.push_back(*std::move(place));
    return places;
}

std::string placeName(std::string_view typed) {
    std::string name;
    for (const char c : typed) name += static_cast<unsigned char>(c) < ' ' || c == 127 ? ' ' : c;
    name.erase(0, std::min(name.find_first_not_of(' '), name.size()));
    if (name.size() > kMaxPlaceName) {
        std::size_t end = kMaxPlaceName;
        while (end > 0 && isContinuation(name[end])) --end;
        name.resize(end);
    }
    name.resize(name.find_last_not_of(' ') + 1);
    return name;
}

base::Result<std::string> namedPlace(const std::vector<Place>& places, std::string_view typed) {
    std::vector<std::string> known;
    for (const Place& place : places) known.push_back(place.name);
    std::string former = placeName(typed);
    if (std::ranges::count(known, former) > 0) return former;
    auto name = TERRANE_TRY(base::checkName(former, kMaxPlaceName));
    const std::string like = std::ranges::count(known, name) > 0 ? name : base::nameLike(name, known);
    if (!like.empty() && like != name)
        return base::fail(base::ErrorCode::BadInput, "the name {} looks like that of the place {}", name,
                          like);
    return name;
}

base::Result<void> namePlace(std::vector<Place>& places, std::string_view typed, const world::Pose& pose) {
    const auto name = TERRANE_TRY(namedPlace(places, typed));
    if (!putPlace(places, name, pose))
        return base::fail(base::ErrorCode::BadInput, "there are {} named places, the maximum", kMaxPlaces);
    return {};
}

bool putPlace(std::vector<Place>& places, std::string_view typed, const world::Pose& pose) {
    const std::string name = placeName(typed);
    if (name.empty()) return false;
    const auto same = std::ranges::find(places, name, &Place::name);
    if (same != places.end()) {
        same->pose = pose;
        return true;
    }
    if (places.size() >= kMaxPlaces) return false;
    places.push_back({name, pose});
    return true;
}

std::vector<Place> savedPlaces(store::ReadableStore& store) {
    return placesFrom(store.metadata(kPlacesMetadata).value_or(""));
}

store::SaveNumber savePlaces(store::ChunkStore& store, const std::vector<Place>& places) {
    return store.setMetadata(kPlacesMetadata, textOf(places));
}

double compassDegrees(double x, double y) {
    const double degrees = glm::degrees(std::atan2(-x, -y));
    return degrees < 0 ? degrees + 360 : degrees;
}

double compassDegrees(float yaw) {
    const double radians = glm::radians(double{yaw});
    return compassDegrees(std::cos(radians), std::sin(radians));
}

double distanceBetween(const world::Pose& from, const world::Pose& to) {
    return glm::distance(from.position, to.position);
}

namespace {

base::Result<void> readInto(std::vector<world::Pose>& bookmarks, const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return {};
    const auto text = TERRANE_TRY(base::readFile(file));
    std::istringstream in(text);
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        const auto pose = parsePose(line);
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

void reportLegacyFiles(const BookmarkFiles& files) {
    std::error_code ignored;
    for (const std::filesystem::path& legacy : files.legacy)
        if (std::filesystem::exists(legacy, ignored) && !isSameFile(legacy, files.file))
            base::logInfo("{}: its bookmarks are read from the working directory; new ones go to {}",
                          legacy.string(), files.file.string());
}

base::Result<std::vector<world::Pose>> readBookmarks(const BookmarkFiles& files) {
    std::vector<world::Pose> bookmarks;
    for (const std::filesystem::path& legacy : files.legacy) {
        if (isSameFile(legacy, files.file)) continue;
        TERRANE_TRY(readInto(bookmarks, legacy));
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
