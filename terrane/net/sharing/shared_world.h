// Communication between the servers of one world: they agree on the order of edits, share their players and
// chat. Implemented by shared records (ServerRecords::shared()), such as net_postgres. On the server's
// thread.
//
// An edit is applied at once where it is made and decided later, in one order for all servers. It is accepted
// unless another server changed one of its blocks before, unknown to this one. Every server sees the same
// order, so all have the same blocks after all events (server_sharing.h).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "terrane/game/places.h"
#include "terrane/net/server/server_records.h"
#include "terrane/net/wire/wire.h"

namespace terrane::net {

// The decision on an append().
struct WriteDecision {
    std::uint64_t write = 0;
    bool isAccepted = false;
    std::int64_t firstNumber = 0;  // number of its first edit, if accepted
};
// An edit of another server, or a decision on an own write.
using HistoryEvent = std::variant<LoggedEdit, WriteDecision>;

struct OtherPlayer {
    game::PlayerId id = game::kNoPlayer;
    WirePose pose;
    bool swings = false;  // broke or placed a block since the last message
};
struct SharedLine {
    std::string name, text;  // no name: sent by the servers
};
// A place was named, moved or removed.
struct PlaceChange {
    std::string name;  // game::placeName()
    WirePose pose;
    bool isGone = false;
};
struct OtherServer {
    std::int64_t number = 0;
    std::string name, address, key;  // "host:port" where players reach it, its public key
    bool isAlive = true;
    // If the server stopped without saving: the chunks that it changed and did not save. Call
    // removeStoppedServer() once they are in the store.
    std::vector<world::ChunkPos> unsaved = {};
};

// Events since the last call, in order.
struct SharedChanges {
    std::vector<HistoryEvent> history;
    std::int64_t newest = 0;  // all edits up to this one were reported
    std::int64_t saved = 0;   // all edits up to this one are in the world's store

    std::vector<KnownPlayer> players;     // new or changed
    std::vector<game::PlayerId> refused;  // addPlayer() failed: another server used the name at the same time
    std::vector<game::PlayerId> joined;   // on another server
    std::vector<game::PlayerId> left;     // another server
    std::optional<std::vector<game::Claim>> claims;  // all claims, if some changed
    std::vector<SharedLine> lines;
    std::optional<std::string> passwordHash;  // if changed
    std::optional<double> timeDay;            // if set by a command
    std::vector<OtherPlayer> poses;
    // All places, if changes may have been missed; `places` are newer.
    std::optional<std::vector<game::Place>> allPlaces;
    std::vector<PlaceChange> places;
    std::vector<world::ChunkPos> tiles;               // written by other servers
    std::optional<std::vector<OtherServer>> servers;  // all other servers, if queried
};

// Region in which one server lets time pass: 32 × 32 chunks.
using Region = std::int64_t;
constexpr Region regionOf(world::ChunkPos chunk) {
    return (std::int64_t{chunk.x} >> 5) << 32 | static_cast<std::uint32_t>(chunk.y >> 5);
}

class SharedWorld {
  public:
    virtual ~SharedWorld() = default;

    // A later append() counts as made with knowledge of all news returned here.
    virtual SharedChanges popChanges() = 0;

    virtual void say(const SharedLine& line) = 0;
    virtual void publishTime(double timeDay) = 0;
    virtual void publishPoses(std::span<const OtherPlayer> players) = 0;  // players that moved
    virtual void publishPlace(const PlaceChange& change) = 0;
    virtual void publishTiles(std::span<const world::ChunkPos> tiles) = 0;
    // A player is on one server at a time: other servers disconnect it.
    virtual void publishJoined(game::PlayerId player) = 0;
    virtual void publishLeft(game::PlayerId player) = 0;
    // A number for a new player; kNoPlayer if none is available at the moment.
    virtual game::PlayerId allocatePlayerId() = 0;

    // Call once a second. `saved`: all changes of this server up to this edit are in the store.
    virtual void publishState(int players, std::int64_t saved) = 0;
    // Requests leases of these regions instead of earlier ones. Time passes in a region only if mayGrow().
    virtual void requestRegions(std::vector<Region> regions) = 0;
    virtual bool mayGrow(Region region) const = 0;

    virtual void removeStoppedServer(std::int64_t server) = 0;
};

}  // namespace terrane::net
