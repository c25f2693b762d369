#include "terrane/net/server/server_players.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "terrane/base/log.h"
#include "terrane/base/match.h"
#include "terrane/base/names.h"
#include "terrane/net/server/server_clients.h"
#include "terrane/net/server/server_commands.h"
#include "terrane/net/server/server_console.h"
#include "terrane/net/wire/wire.h"

namespace terrane::net {

namespace {

void makeChange(std::vector<game::Place>& places, const PlaceChange& change) {
    if (change.isGone)
        std::erase_if(places, [&](const game::Place& place) { return place.name == change.name; });
    else
        (void)game::putPlace(places, change.name, poseOf(change.pose));
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

std::vector<game::Place> placesOf(ServerState& server) {
    return game::savedPlaces(server.session.store());
}

bool hasPlace(const std::vector<game::Place>& places, std::string_view name) {
    return std::ranges::count(places, name, &game::Place::name) > 0;
}

// The known name that was typed, in another normal form if need be.
std::string knownName(const std::vector<game::Place>& places, std::string_view typed) {
    const std::string name = game::placeName(typed);
    return hasPlace(places, name) ? name : base::normalizedName(name);
}

}  // namespace

void applyPlaceChange(ServerState& server, const PlaceChange& change) {
    (void)changeHere(server, change);
}

void replacePlaces(ServerState& server, const std::vector<game::Place>& places) {
    std::vector<game::Place> all = places;
    for (const auto& [save, change] : server.sharing.untoldPlaces) makeChange(all, change);
    if (game::textOf(all) != game::textOf(game::savedPlaces(server.session.store())))
        game::savePlaces(server.session.store(), all);
}

void publishSavedPlaces(ServerState& server) {
    auto& untold = server.sharing.untoldPlaces;
    if (untold.empty()) return;
    const store::SaveNumber durable = server.session.store().status().durable;
    for (; !untold.empty() && untold.front().first <= durable; untold.pop_front())
        server.sharing.shared->publishPlace(untold.front().second);
}

std::string markPlace(ServerState& server, std::string_view typed, const world::Pose& pose) {
    if (game::placeName(typed).empty()) return "a place needs a name: mark NAME";
    const std::vector<game::Place> all = placesOf(server);
    const auto name = game::namedPlace(all, typed);
    if (!name) return name.error().message;
    if (!hasPlace(all, *name) && all.size() >= game::kMaxPlaces)
        return fmt::format("there are {} named places, the maximum: remove one with unmark",
                           game::kMaxPlaces);
    change(server, {*name, wirePose(pose), false});
    return fmt::format("{} is marked", *name);
}

std::string unmarkPlace(ServerState& server, std::string_view typed) {
    const std::vector<game::Place> all = placesOf(server);
    const std::string name = knownName(all, typed);
    if (!hasPlace(all, name)) return fmt::format("there is no place {}: marks lists them", name);
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

std::string markHere(ServerState& server, const ServerClient& client, std::string_view typed) {
    if (client.role == game::Role::Guest) return "guests cannot mark places";
    const world::Pose pose = poseOf(client.pose);
    if (client.role == game::Role::Operator) return markPlace(server, typed, pose);
    const std::vector<game::Place> all = placesOf(server);
    if (game::placeName(typed).empty()) return "a place needs a name: mark NAME";
    const auto name = game::namedPlace(all, typed);
    if (!name) return name.error().message;
    auto own = server.placeOwners.placesOf(client.player, all);
    if (!own) return own.error().message;
    if (std::erase_if(*own, [&](const game::Place& place) { return place.name == *name; }) == 0) {
        if (hasPlace(all, *name))
            return fmt::format("there is a place {} of another: only operators can move it", *name);
        if (own->size() >= server.settings.maxPlacesOfPlayer)
            return fmt::format(
                "you have named {} places, the maximum of a player: remove one with /unmark NAME",
                own->size());
        if (all.size() + kPlacesOfOperators >= game::kMaxPlaces)
            return fmt::format("there are {} named places: only operators can name more", all.size());
    }
    const std::string answer = markPlace(server, *name, pose);
    for (const game::Place& place : placesOf(server))
        if (place.name == *name) own->push_back(place);
    server.placeOwners.set(client.player, *own);
    return answer;
}

std::string unmarkOwn(ServerState& server, const ServerClient& client, std::string_view typed) {
    const std::vector<game::Place> all = placesOf(server);
    if (client.role == game::Role::Guest) return "guests cannot unmark places";
    const std::string name = knownName(all, typed);
    const auto own = server.placeOwners.placesOf(client.player, all);
    if (!own) return own.error().message;
    if (!hasPlace(*own, name)) return fmt::format("you have named no place {}", name);
    return unmarkPlace(server, name);
}

namespace {

// Lines of chat of all players of an address: five times those of a player.
const base::TokenBucket kChatOfAddress{5, 40};
constexpr std::uint64_t kTicksPerPing = 100, kTicksPerClock = 200;
// Maximum distance in chunks between a client's last known position and the center of its view. The client
// may have moved since.
constexpr int kViewAway = 4;

bool isInWorld(const WirePose& pose) {
    return world::isInWorld(world::chunkOf(poseOf(pose).position));
}

void onMove(ServerState& server, ServerClient& client, const Move& move) {
    const bool isFree = client.role == game::Role::Operator;
    const double blocks = distanceBetween(client.pose, move.pose);
    if (!isInWorld(move.pose) || (!isFree && !client.buckets.blocksAway.take(blocks, server.now)))
        return send(client, Corrected{client.pose});
    client.pose = move.pose;
    server.session.setPlayer(client.player, poseOf(move.pose));
}

void onView(ServerClient& client, const View& view) {
    const world::ChunkPos own = world::chunkOf(poseOf(client.pose).position);
    // A corrected client asks for a distant view until Corrected arrives.
    if (world::chunkDistance(own, view.center) <= kViewAway) client.askedView = view;
}

void onSay(ServerState& server, ServerClient& client, const Say& message) {
    if (!client.buckets.chat.take(1, server.now)) return say(client, "you chat too fast");
    const bool isOperator = client.role == game::Role::Operator;
    if (!isOperator && !takeOfAddress(server.chatOfAddress, client.address, kChatOfAddress, server.now))
        return say(client, "too many lines come from your address");
    if (message.text.empty()) return;
    if (message.text.front() != '/') {
        base::logInfo("<{}> {}", client.name, message.text);
        return broadcastChat(server, client.name, message.text);
    }
    constexpr std::string_view kMark = "/mark ";
    if (message.text.starts_with(kMark))
        return say(client, markHere(server, client, std::string_view(message.text).substr(kMark.size())));
    constexpr std::string_view kUnmark = "/unmark ";
    if (message.text.starts_with(kUnmark) && !isOperator)
        return say(client, unmarkOwn(server, client, std::string_view(message.text).substr(kUnmark.size())));
    if (!isOperator) return say(client, "only operators can give commands");
    // Without the arguments, which may contain a password.
    base::logInfo("{} gives the command {}", client.name, message.text.substr(0, message.text.find(' ')));
    say(client, runConsoleLine(server, message.text.substr(1)));
}

void onAskPlayers(ServerState& server, ServerClient& client) {
    if (!client.buckets.lists.take(1, server.now)) return;
    PlayerList list;
    forEachPlaying(server, [&](const ServerClient& other) {
        const auto latency = other.latency.value_or(std::chrono::milliseconds(0)).count();
        if (list.players.size() < kMaxPlayersInMessage)
            list.players.push_back({other.name, other.role,
                                    static_cast<std::uint16_t>(std::clamp<std::int64_t>(latency, 0, 65535))});
    });
    for (const auto& [id, other] : server.sharing.players) {
        const KnownPlayer* known = server.knownPlayers.byId(id);
        if (known && !server.playing.contains(id) && list.players.size() < kMaxPlayersInMessage)
            list.players.push_back({known->name, known->role, 0});
    }
    send(client, list);
}

// The server's clock in milliseconds, modulo 2^32, for Ping.
std::uint32_t pingTime(Time now) {
    const auto since = std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch());
    return static_cast<std::uint32_t>(since.count());
}

void sendVisibility(ServerState& server, ServerClient& client, const PlayerGrid& grid) {
    const SightChanges changes =
        client.sight.update(server.tick, grid.around({client.player, client.pose, client.swungTick}));
    for (const std::uint16_t slot : changes.disappeared) send(client, Disappears{slot});
    for (const auto& [slot, player] : changes.appeared) {
        const KnownPlayer* known = server.knownPlayers.byId(player->id);
        send(client, Appears{slot, player->id, known ? known->name : std::string(), player->pose});
    }
    if (!changes.poses.empty()) send(client, Poses{changes.poses});
}

}  // namespace

void onPlayerMessage(ServerState& server, ServerClient& client, ClientMessage message) {
    std::visit(base::Match{
                   [&](const Move& move) { onMove(server, client, move); },
                   [&](const View& view) { onView(client, view); },
                   [&](Edit& edit) {
                       enqueueCommand(server, client, {std::move(edit), server.tick});
                   },
                   [&](const Fill& fill) {
                       enqueueCommand(server, client, {Build{fill.number, fill.fill}, server.tick});
                   },
                   [&](const Place& place) { takePlace(server, client, place); },
                   [&](const TakeBack& takeBack) {
                       enqueueCommand(server, client, {takeBack, server.tick});
                   },
                   [&](const Say& text) { onSay(server, client, text); },
                   [&](const AskPlayers&) { onAskPlayers(server, client); },
                   [&](const Pong& pong) {
                       client.latency = std::chrono::milliseconds(pingTime(server.now) - pong.time);
                   },
                   [&](const Leave&) { leave(server, client); },
                   base::on<Hello, Login, Proof, AskPack>([&] { refuseUnexpected(server, client, message); }),
               },
               message);
}

void broadcastVisibility(ServerState& server) {
    std::vector<PlayerAt> players;
    forEachPlaying(server, [&](const ServerClient& client) {
        players.push_back({client.player, client.pose, client.swungTick});
    });
    for (const auto& [id, other] : server.sharing.players)
        if (!server.playing.contains(id)) players.push_back(other.at);
    const PlayerGrid grid(players);
    // Updates half of the clients in each tick, to spread the traffic over time.
    forEachPlaying(server, [&](ServerClient& client) {
        if ((server.tick + client.id) % kTicksPerSight == 0) sendVisibility(server, client, grid);
    });
}

void sendKeepAlives(ServerState& server) {
    forEachPlaying(server, [&](ServerClient& client) {
        if (server.now - client.heardAt > server.settings.silentAfter)
            return refuse(server, client, Refusal::Silent, "no message from you for too long");
        if ((server.tick + client.id) % kTicksPerPing == 0) send(client, Ping{pingTime(server.now)});
        if ((server.tick + client.id) % kTicksPerClock == 0) send(client, clockOf(server));
        if (client.outgoing.size() + client.unsent > server.settings.maxUnsentBytes)
            refuse(server, client, Refusal::TooSlow, "your connection is too slow for the server's messages");
    });
}

}  // namespace terrane::net
