#include "terrane/net/server/server_players.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "terrane/base/log.h"
#include "terrane/base/match.h"
#include "terrane/base/names.h"
#include "terrane/base/text.h"
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

store::SaveNumber changeHere(store::ChunkStore& store, const PlaceChange& change) {
    std::vector<game::Place> places = game::savedPlaces(store);
    makeChange(places, change);
    return game::savePlaces(store, places);
}

// Changes a place here and on the other servers of the world.
void change(ServerPlaces& places, const PlaceChange& change) {
    const store::SaveNumber save = changeHere(places.store, change);
    if (places.shared) places.untold.push_back({save, change});
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

void applyPlaceChange(ServerPlaces& places, const PlaceChange& change) {
    (void)changeHere(places.store, change);
}

void replacePlaces(ServerPlaces& places, const std::vector<game::Place>& stored) {
    std::vector<game::Place> all = stored;
    for (const auto& [save, change] : places.untold) makeChange(all, change);
    if (game::textOf(all) != game::textOf(game::savedPlaces(places.store)))
        game::savePlaces(places.store, all);
}

void publishSavedPlaces(ServerPlaces& places) {
    auto& untold = places.untold;
    if (untold.empty()) return;
    const store::SaveNumber durable = places.store.status().durable;
    for (; !untold.empty() && untold.front().first <= durable; untold.pop_front())
        places.shared->publishPlace(untold.front().second);
}

std::string markPlace(ServerPlaces& places, std::string_view typed, const world::Pose& pose) {
    if (game::placeName(typed).empty()) return "a place needs a name: mark NAME";
    const std::vector<game::Place> all = game::savedPlaces(places.store);
    const auto name = game::namedPlace(all, typed);
    if (!name) return name.error().message;
    if (!hasPlace(all, *name) && all.size() >= game::kMaxPlaces)
        return fmt::format("there are {} named places, the maximum: remove one with unmark",
                           game::kMaxPlaces);
    change(places, {*name, wirePose(pose), false});
    return fmt::format("{} is marked", *name);
}

std::string unmarkPlace(ServerPlaces& places, std::string_view typed) {
    const std::vector<game::Place> all = game::savedPlaces(places.store);
    const std::string name = knownName(all, typed);
    if (!hasPlace(all, name)) return fmt::format("there is no place {}: marks lists them", name);
    change(places, {name, {}, true});
    return fmt::format("{} is no longer marked", name);
}

std::string placeList(const ServerPlaces& places) {
    const std::vector<game::Place> all = game::savedPlaces(places.store);
    std::string text = base::counted(all.size(), "place");
    for (const game::Place& place : all) {
        const auto& at = place.pose.position;
        text += fmt::format("\n{} at {:.0f} {:.0f} {:.0f}", place.name, at.x, at.y, at.z);
    }
    return text;
}

std::string markHere(ServerPlaces& places, const ServerClient& client, std::string_view typed) {
    if (client.role == game::Role::Guest) return "guests cannot mark places";
    const world::Pose pose = poseOf(client.pose);
    if (client.role == game::Role::Operator) return markPlace(places, typed, pose);
    const std::vector<game::Place> all = game::savedPlaces(places.store);
    if (game::placeName(typed).empty()) return "a place needs a name: mark NAME";
    const auto name = game::namedPlace(all, typed);
    if (!name) return name.error().message;
    auto own = places.owners.placesOf(client.player, all);
    if (!own) return own.error().message;
    if (std::erase_if(*own, [&](const game::Place& place) { return place.name == *name; }) == 0) {
        if (hasPlace(all, *name))
            return fmt::format("there is a place {} of another: only operators can move it", *name);
        if (own->size() >= places.settings.maxPlacesOfPlayer)
            return fmt::format("you have named {}, the maximum of a player: remove one with /unmark NAME",
                               base::counted(own->size(), "place"));
        if (all.size() + kPlacesOfOperators >= game::kMaxPlaces)
            return fmt::format("there are {} named places: only operators can name more", all.size());
    }
    const std::string answer = markPlace(places, *name, pose);
    for (const game::Place& place : game::savedPlaces(places.store))
        if (place.name == *name) own->push_back(place);
    places.owners.set(client.player, *own);
    return answer;
}

std::string unmarkOwn(ServerPlaces& places, const ServerClient& client, std::string_view typed) {
    const std::vector<game::Place> all = game::savedPlaces(places.store);
    if (client.role == game::Role::Guest) return "guests cannot unmark places";
    const std::string name = knownName(all, typed);
    const auto own = places.owners.placesOf(client.player, all);
    if (!own) return own.error().message;
    if (!hasPlace(*own, name)) return fmt::format("you have named no place {}", name);
    return unmarkPlace(places, name);
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

void onMove(game::Session& session, ServerClient& client, const Move& move, Time now) {
    const bool isFree = client.role == game::Role::Operator;
    const double blocks = distanceBetween(client.pose, move.pose);
    if (!isInWorld(move.pose) || (!isFree && !client.buckets.blocksAway.take(blocks, now)))
        return send(client, Corrected{client.pose});
    client.pose = move.pose;
    session.setPlayer(client.player, poseOf(move.pose));
}

void onView(ServerClient& client, const View& view) {
    const world::ChunkPos own = world::chunkOf(poseOf(client.pose).position);
    // A corrected client asks for a distant view until Corrected arrives.
    if (world::chunkDistance(own, view.center) <= kViewAway) client.askedView = view;
}

void onSay(ServerState& server, ServerClient& client, const Say& message) {
    const bool isOperator = client.role == game::Role::Operator;
    const bool isCommand = isOperator && message.text.starts_with('/');
    if (!isCommand && !client.buckets.chat.take(1, server.clients.now))
        return say(client, "you chat too fast");
    if (!isOperator &&
        !takeOfAddress(server.clients.chatOfAddress, client.address, kChatOfAddress, server.clients.now))
        return say(client, "too many lines come from your address");
    if (message.text.empty()) return;
    game::Session& session = server.session;
    if (message.text.front() != '/') {
        if (!game::mayChat(session, client.player, message.text)) return;
        base::logInfo("<{}> {}", client.name, message.text);
        broadcastChat(server.clients, client.name, message.text);
        return session.events.chat.notify({client.player, message.text});
    }
    constexpr std::string_view kMark = "/mark ";
    if (message.text.starts_with(kMark))
        return say(client,
                   markHere(server.places, client, std::string_view(message.text).substr(kMark.size())));
    constexpr std::string_view kUnmark = "/unmark ";
    if (message.text.starts_with(kUnmark) && !isOperator)
        return say(client,
                   unmarkOwn(server.places, client, std::string_view(message.text).substr(kUnmark.size())));
    if (game::runChatCommand(session, client.player, std::string_view(message.text).substr(1))) return;
    if (message.text == "/help" && !session.chatCommands.empty()) {
        say(client, game::chatHelp(session.chatCommands));
        if (!isOperator) return;
    }
    if (!isOperator) return say(client, "only operators can give commands");
    // Without the arguments, which may contain a password.
    base::logInfo("{} gives the command {}", client.name, message.text.substr(0, message.text.find(' ')));
    say(client, runConsoleLine(server, message.text.substr(1), CommandFrom::Chat));
}

void onAskPlayers(ServerClients& clients, ServerClient& client) {
    if (!client.buckets.lists.take(1, clients.now)) return;
    PlayerList list;
    forEachPlaying(clients, [&](const ServerClient& other) {
        const auto latency = other.latency.value_or(std::chrono::milliseconds(0)).count();
        if (list.players.size() < kMaxPlayersInMessage)
            list.players.push_back({other.name, other.role,
                                    static_cast<std::uint16_t>(std::clamp<std::int64_t>(latency, 0, 65535))});
    });
    forEachElsewhere(clients, [&](const KnownPlayer& other, const PlayerAt&) {
        if (list.players.size() < kMaxPlayersInMessage) list.players.push_back({other.name, other.role, 0});
    });
    send(client, list);
}

// The server's clock in milliseconds, modulo 2^32, for Ping.
std::uint32_t pingTime(Time now) {
    const auto since = std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch());
    return static_cast<std::uint32_t>(since.count());
}

void sendVisibility(const ServerClients& clients, ServerClient& client, const PlayerGrid& grid) {
    const SightChanges changes =
        client.sight.update(clients.tick, grid.around({client.player, client.pose, client.swungTick}));
    for (const std::uint16_t slot : changes.disappeared) send(client, Disappears{slot});
    for (const auto& [slot, player] : changes.appeared) {
        const KnownPlayer* known = clients.known.byId(player->id);
        send(client, Appears{slot, player->id, known ? known->name : std::string(), player->pose});
    }
    if (!changes.poses.empty()) send(client, Poses{changes.poses});
}

}  // namespace

void onPlayerMessage(ServerState& server, ServerClient& client, ClientMessage message) {
    ServerClients& clients = server.clients;
    game::Session& session = server.session;
    const auto enqueue = [&](auto command) {
        enqueueCommand(clients, client, session, {std::move(command), clients.tick});
    };
    std::visit(base::Match{
                   [&](const Move& move) { onMove(session, client, move, clients.now); },
                   [&](const View& view) { onView(client, view); },
                   [&](Edit& edit) { enqueue(std::move(edit)); },
                   [&](const Fill& fill) {
                       enqueue(Build{fill.number, fill.fill});
                   },
                   [&](const Place& place) {
                       enqueue(buildFrom(place, client.buckets, session.blocks(), clients.now));
                   },
                   [&](const TakeBack& takeBack) { enqueue(takeBack); },
                   [&](const ItemCommand& command) { enqueue(command); },
                   [&](const Say& text) { onSay(server, client, text); },
                   [&](const AskPlayers&) { onAskPlayers(clients, client); },
                   [&](const Pong& pong) {
                       client.latency = std::chrono::milliseconds(pingTime(clients.now) - pong.time);
                   },
                   [&](const Leave&) { leave(clients, client); },
                   [&](const OfLogin auto&) { refuseUnexpected(clients, client, message); },
               },
               message);
}

void broadcastVisibility(ServerClients& clients) {
    std::vector<PlayerAt> players;
    forEachPlaying(clients, [&](const ServerClient& client) {
        players.push_back({client.player, client.pose, client.swungTick});
    });
    for (const auto& [id, other] : clients.elsewhere)
        if (!clients.playing.contains(id)) players.push_back(other.at);
    const PlayerGrid grid(players);
    // Updates half of the clients in each tick, to spread the traffic over time.
    forEachPlaying(clients, [&](ServerClient& client) {
        if ((clients.tick + client.id) % kTicksPerSight == 0) sendVisibility(clients, client, grid);
    });
}

void sendKeepAlives(ServerClients& clients, const game::DayClock& clock) {
    forEachPlaying(clients, [&](ServerClient& client) {
        if (clients.now - client.heardAt > clients.settings.silentAfter)
            return refuse(clients, client, Refusal::Silent, "no message from you for too long");
        if ((clients.tick + client.id) % kTicksPerPing == 0) send(client, Ping{pingTime(clients.now)});
        if ((clients.tick + client.id) % kTicksPerClock == 0) send(client, clockOf(clock));
        if (client.outgoing.size() + client.unsent > clients.settings.maxUnsentBytes)
            refuse(clients, client, Refusal::TooSlow,
                   "your connection is too slow for the server's messages");
    });
}

}  // namespace terrane::net
