// One connection as the server knows it: who it is, what it may do, what it sees, what waits for it. Plain
// data, on the server's thread.
#pragma once

#include <chrono>
#include <deque>
#include <optional>
#include <string>
#include <unordered_set>
#include <variant>
#include <vector>

#include "terrane/base/token_bucket.h"
#include "terrane/net/client_message.h"
#include "terrane/net/server_message.h"
#include "terrane/net/sight.h"

namespace terrane::net {

using Time = std::chrono::steady_clock::time_point;
using ConnectionId = std::uint64_t;  // ascending

// What a client may do, beyond which it waits or is sent away.
struct ClientBuckets {
    base::TokenBucket messages{120, 400};
    base::TokenBucket blocks{20000, 131072};  // of Fill and Place
    base::TokenBucket edits{60, 240};
    base::TokenBucket chat{1, 8};
    base::TokenBucket lists{1, 4};
    base::TokenBucket joins{0.2, 10};
    base::TokenBucket blocksAway;  // movement; ServerSettings::maxSpeed

    explicit ClientBuckets(double maxSpeed) : blocksAway(maxSpeed, 2 * maxSpeed) {}
};

// Fill or Place.
struct Build {
    CommandNumber number = 0;
    game::BuildChange change;
};
struct WaitingCommand {
    std::variant<Edit, Build, TakeBack> command;
    std::uint64_t since = 0;  // tick: a server that stalls lets nobody wait in vain
};
// A decision that is told once it is in the file.
struct Decision {
    std::uint64_t write = 0;  // ServerRecords::durable(); 0: nothing was written
    Done done;
    // What it becomes where another server was first with one of its blocks.
    std::uint8_t resultIfRefused = 0;
};

// Of a player who left: its steps to undo are kept for a while, and what it may do does not begin anew.
struct FormerClient {
    Time at;
    ClientBuckets buckets;
};

// Where a client connects from.
struct ClientAddress {
    std::string shown;    // in the log
    std::string network;  // by which limits count: base::networkOf()
    bool isOwnMachine = false;
};

struct ServerClient {
    enum class Stage : std::uint8_t { Hello, Login, Password, Proof, Playing, Closed };

    ServerClient(ConnectionId number, double maxSpeed) : id(number), buckets(maxSpeed) {}

    ConnectionId id;
    ClientAddress address;
    Bytes channel;  // the connection's exported keying material
    Nonce nonce{};
    Stage stage = Stage::Hello;
    Time openedAt{}, heardAt{};
    ClientBuckets buckets;

    // From Login on.
    std::string name;
    PublicKey key{};
    std::vector<std::uint32_t> sentOfPacks;  // bytes of each, by its number in the offer
    int packParts = 0;                       // that were sent

    // Of who plays.
    game::PlayerId player = game::kNoPlayer;
    game::Role role = game::Role::Player;
    WirePose pose;
    std::uint64_t swungTick = 0;
    std::optional<Time> builtAt;  // of its last edit
    std::optional<std::chrono::milliseconds> latency;
    Sight sight;
    std::deque<WaitingCommand> commands;
    std::size_t waitingBytes = 0;  // of data of blocks in them
    std::deque<Decision> decisions;

    // What it sees (server_view.h).
    std::optional<View> view, askedView;                            // the latter from the next tick on
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> told;  // chunks and tiles
    std::vector<world::ChunkPos> toTell;                            // the nearest last
    bool owesViewComplete = false;

    Bytes outgoing;          // frames
    std::size_t unsent = 0;  // bytes that the transport has and could not send yet
};

}  // namespace terrane::net
