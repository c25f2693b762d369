// Places of a world that have names, such as "home": kept in the world's metadata. Plain values.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/store/chunk_store.h"
#include "terrane/world/pose.h"

namespace terrane::game {

struct Place {
    std::string name;  // one line, 1 to kMaxPlaceName bytes
    world::Pose pose;

    bool operator==(const Place&) const = default;
};

constexpr std::size_t kMaxPlaces = 200, kMaxPlaceName = 60;

// A line a place, "X Y Z YAW PITCH NAME".
std::string textOf(const std::vector<Place>& places);
// The name may be missing. Nothing for anything else.
std::optional<Place> placeFrom(const std::string& line);
// Lines that are no place, or have no name, are left out, and what is beyond kMaxPlaces.
std::vector<Place> placesFrom(std::string_view text);

// Without control characters and spaces at its ends; cut to kMaxPlaceName bytes, between characters.
std::string placeName(std::string_view typed);
// Gives the place its name: a place of the same name moves there. False where there are kMaxPlaces already or
// the name is empty.
bool namePlace(std::vector<Place>& places, std::string_view name, const world::Pose& pose);

// In the store's metadata.
inline constexpr const char* kPlacesMetadata = "places";
std::vector<Place> savedPlaces(store::ReadableStore& store);
store::SaveNumber savePlaces(store::ChunkStore& store, const std::vector<Place>& places);

// What a compass shows of a direction over the ground: degrees from north toward east, 0…360. The sun rises
// in the east, which is -x; north is -y.
double compassDegrees(double x, double y);
double compassDegrees(float yaw);

}  // namespace terrane::game
