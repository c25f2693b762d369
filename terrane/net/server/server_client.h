// The server's state of one connection: identity, permissions, view, queued data. Plain data, on the server's
// thread.
#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <unordered_set>
#include <variant>
#include <vector>

#include "terrane/base/timing.h"
#include "terrane/net/server/sight.h"
#include "terrane/net/wire/client_message.h"
#include "terrane/net/wire/server_message.h"

namespace terrane::net {

using Time = std::chrono::steady_clock::time_point;
using ConnectionId = std::uint64_t;  // ascending

// Rate limits of a client; beyond them its requests wait or it is disconnected.
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

// A Fill or Place message.
struct Build {
    CommandNumber number = 0;
    game::BuildChange change;
};
struct WaitingCommand {
    std::variant<Edit, Build, TakeBack, ItemCommand> command;
    std::uint64_t since = 0;  // tick number: time in which the server stalls does not count
};
// A decision that is sent once its edits are durable.
struct Decision {
    std::uint64_t write = 0;  // ServerRecords::durable(); 0: nothing was written
    Done done;
    // Result to send if another server changed one of the blocks first.
    std::uint8_t resultIfRefused = 0;
};

// State of a player who left: undo steps are kept for a while, and rate limits continue on return.
struct FormerClient {
    Time at;
    ClientBuckets buckets;
};

// The network address of a client.
struct ClientAddress {
    std::string shown;    // for the log
    std::string network;  // key of the limits per address: base::networkOf()
    bool isOwnMachine = false;
};

// Rate limits by ClientAddress::network.
using AddressBuckets = std::map<std::string, base::TokenBucket>;

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
    std::vector<std::uint32_t> sentOfPacks;  // bytes sent of each pack, by index in the offer
    int packParts = 0;                       // parts sent

    // While playing.
    game::PlayerId player = game::kNoPlayer;
    game::Role role = game::Role::Player;
    WirePose pose;
    std::uint64_t swungTick = 0;
    std::optional<Time> builtAt;  // time of the last edit
    std::optional<std::chrono::milliseconds> latency;
    Sight sight;
    std::deque<WaitingCommand> commands;
    std::size_t waitingBytes = 0;  // block entity data in `commands`
    std::deque<Decision> decisions;

    // View (server_view.h).
    std::optional<View> view, askedView;                            // asked: for the next tick
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> told;  // chunks and tiles known to the client
    std::unordered_set<world::ChunkPos, world::ChunkPosHash>
        withheld;                         // of these: not told below view->lowest
    std::vector<world::ChunkPos> toTell;  // to send, the nearest last
    bool owesViewComplete = false;

    Bytes outgoing;          // frames
    std::size_t unsent = 0;  // bytes passed to the transport and not sent yet
};

}  // namespace terrane::net
