#include "terrane/game/places.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <sstream>

#include "terrane/game/pose_text.h"

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
    const auto at = poseFrom(pose);
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

bool namePlace(std::vector<Place>& places, std::string_view typed, const world::Pose& pose) {
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

}  // namespace terrane::game
