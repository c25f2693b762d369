// What servers of one world do for each other: they agree on the order of edits, see each other's players,
// and talk. Records that several servers share have this besides (ServerRecords::shared()); net_postgres has
// one. On the server's thread.
//
// An edit is applied where it is made, at once, and decided later, in one order for all servers: it is
// accepted unless another server changed one of its blocks before, which this one had not heard of. Each
// server hears the same order. So all have the same blocks once they have heard all (server_sharing.h).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "terrane/game/places.h"
#include "terrane/net/server_records.h"
#include "terrane/net/wire_pose.h"

namespace terrane::net {

// What became of an append().
struct WriteDecision {
    std::uint64_t write = 0;
    bool isAccepted = false;
    std::int64_t firstNumber = 0;  // of its edits, where it was accepted
};
// An edit of another server, or a decision on an own one.
using HistoryEvent = std::variant<LoggedEdit, WriteDecision>;

struct OtherPlayer {
    game::PlayerId id = game::kNoPlayer;
    WirePose pose;
    bool swings = false;  // broke or placed a block since it was told before
};
struct SharedLine {
    std::string name, text;  // no name: the servers say it
};
// A place got a name or a new place, or lost its name.
struct PlaceChange {
    std::string name;  // game::placeName()
    WirePose pose;
    bool isGone = false;
};
struct OtherServer {
    std::int64_t number = 0;
    std::string name, address, key;  // "host:port" where players reach it, its public key
    int players = 0;
    bool isAlive = true;
    // Of one that is gone without saving: the chunks that it changed and did not save. When these are in the
    // store, forgetServer().
    std::vector<world::ChunkPos> unsaved = {};
};

// What happened since the last call, in its order.
struct SharedNews {
    std::vector<HistoryEvent> history;
    std::int64_t newest = 0;  // all edits up to this one were told by now
    std::int64_t saved = 0;   // all edits up to this one are in the world's store

    std::vector<KnownPlayer> players;     // new or changed
    std::vector<game::PlayerId> refused;  // of addPlayer(): another server gave the name at the same time
    std::vector<game::PlayerId> joined;   // on another server
    std::vector<game::PlayerId> left;     // another server
    std::optional<std::vector<game::Claim>> claims;  // all, where some changed
    std::vector<SharedLine> lines;
    std::optional<std::string> passwordHash;  // where it was changed
    std::optional<double> timeDay;            // where somebody set the time
    std::vector<OtherPlayer> poses;
    // All names of places, where changes may have been missed; `places` are newer.
    std::optional<std::vector<game::Place>> allPlaces;
    std::vector<PlaceChange> places;
    std::vector<world::ChunkPos> tiles;               // that others wrote
    std::optional<std::vector<OtherServer>> servers;  // all others, where that was looked up
};

// Parts of the world in which one server lets time pass: 32 x 32 chunks.
using Region = std::int64_t;
constexpr Region regionOf(world::ChunkPos chunk) {
    return (std::int64_t{chunk.x} >> 5) << 32 | static_cast<std::uint32_t>(chunk.y >> 5);
}

class SharedWorld {
  public:
    virtual ~SharedWorld() = default;

    // What comes after append() was made with all of it in mind.
    virtual SharedNews takeNews() = 0;

    virtual void say(const SharedLine& line) = 0;
    virtual void tellTime(double timeDay) = 0;
    virtual void tellPoses(std::span<const OtherPlayer> players) = 0;  // that moved
    virtual void tellPlace(const PlaceChange& change) = 0;
    virtual void tellTiles(std::span<const world::ChunkPos> tiles) = 0;
    // A player is on one server at a time: it leaves the others, which hear of it.
    virtual void tellJoined(game::PlayerId player) = 0;
    virtual void tellLeft(game::PlayerId player) = 0;
    // A number for a new player, kNoPlayer where none is at hand for the moment.
    virtual game::PlayerId takePlayerNumber() = 0;

    // Once a second: how many play, and up to which edit all that this server changed is in the store.
    virtual void tellState(int players, std::int64_t saved) = 0;
    // Regions that this server would let time pass in; it may where mayGrow().
    virtual void wantRegions(std::vector<Region> regions) = 0;
    virtual bool mayGrow(Region region) const = 0;

    virtual void forgetServer(std::int64_t server) = 0;
};

}  // namespace terrane::net
