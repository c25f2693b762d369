#include "terrane/net/server_places.h"

#include <algorithm>
#include <vector>

#include "terrane/net/plain_text.h"

namespace terrane::net {
namespace {

void makeChange(std::vector<game::Place>& places, const PlaceChange& change) {
    if (change.isGone)
        std::erase_if(places, [&](const game::Place& place) { return place.name == change.name; });
    else
        (void)game::namePlace(places, change.name, poseOf(change.pose));
}

store::SaveNumber changeHere(ServerState& server, const PlaceChange& change) {
    std::vector<game::Place> places = game::savedPlaces(server.session.store());
    makeChange(places, change);
    return game::savePlaces(server.session.store(), places);
}

// Changes a place here and on the other servers of the world.
void change(ServerState& server, const PlaceChange& change) {
    const store::SaveNumber save = changeHere(server, change);
    if (server.sharing.shared) server.sharing.untoldPlaces.push_back({save, change});
}

bool hasPlace(ServerState& server, const std::string& name) {
    return std::ranges::count(game::savedPlaces(server.session.store()), name, &game::Place::name) > 0;
}

}  // namespace

void applyPlaceChange(ServerState& server, const PlaceChange& change) {
    (void)changeHere(server, change);
}

void takeAllPlaces(ServerState& server, const std::vector<game::Place>& places) {
    std::vector<game::Place> all = places;
    for (const auto& [save, change] : server.sharing.untoldPlaces) makeChange(all, change);
    if (game::textOf(all) != game::textOf(game::savedPlaces(server.session.store())))
        game::savePlaces(server.session.store(), all);
}

void tellSavedPlaces(ServerState& server) {
    auto& untold = server.sharing.untoldPlaces;
    if (untold.empty()) return;
    const store::SaveNumber durable = server.session.store().status().durable;
    for (; !untold.empty() && untold.front().first <= durable; untold.pop_front())
        server.sharing.shared->tellPlace(untold.front().second);
}

std::string markPlace(ServerState& server, std::string_view typed, const world::Pose& pose, bool mayMove) {
    const std::string name = game::placeName(typed);
    if (name.empty()) return "a place needs a name: mark NAME";
    if (!isPlainText(name)) return "the name of a place is text in UTF-8 without control characters";
    const bool isTaken = hasPlace(server, name);
    if (isTaken && !mayMove) return fmt::format("there is a place {}: only operators can move it", name);
    if (!isTaken && game::savedPlaces(server.session.store()).size() >= game::kMaxPlaces)
        return fmt::format("there are {} named places, the maximum: remove one with unmark",
                           game::kMaxPlaces);
    change(server, {name, wirePose(pose), false});
    return fmt::format("{} is marked", name);
}

std::string unmarkPlace(ServerState& server, std::string_view typed) {
    const std::string name = game::placeName(typed);
    if (!hasPlace(server, name)) return fmt::format("there is no place {}: marks lists them", name);
    change(server, {name, {}, true});
    return fmt::format("{} is no longer marked", name);
}

std::string placeList(ServerState& server) {
    const std::vector<game::Place> places = game::savedPlaces(server.session.store());
    std::string text = fmt::format("{} places", places.size());
    for (const game::Place& place : places) {
        const auto& at = place.pose.position;
        text += fmt::format("\n{} at {:.0f} {:.0f} {:.0f}", place.name, at.x, at.y, at.z);
    }
    return text;
}

std::string markHere(ServerState& server, const ServerClient& client, std::string_view name) {
    if (client.role == game::Role::Guest) return "guests cannot mark places";
    return markPlace(server, name, poseOf(client.pose), client.role == game::Role::Operator);
}

}  // namespace terrane::net
