// All that a server has while it runs: plain data, without sockets. server.h drives it, server_*.h work on
// it, each on one subject. On the server's thread.
#pragma once

#include <array>
#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "terrane/base/job_system.h"
#include "terrane/game/session.h"
#include "terrane/net/client_message.h"
#include "terrane/net/edit_log.h"
#include "terrane/net/edited_chunks.h"
#include "terrane/net/people.h"
#include "terrane/net/server_message.h"
#include "terrane/net/server_settings.h"
#include "terrane/net/sight.h"
#include "terrane/net/token_bucket.h"

namespace terrane::net {

using Time = std::chrono::steady_clock::time_point;
using ConnectionId = std::uint64_t;  // ascending

constexpr std::chrono::milliseconds kServerTick{50};

// What a client may do, beyond which it waits or is sent away.
struct ClientBuckets {
    TokenBucket messages{120, 400};
    TokenBucket blocks{20000, 131072};  // of Fill and Place
    TokenBucket edits{60, 240};
    TokenBucket chat{1, 8};
    TokenBucket lists{1, 4};
    TokenBucket joins{0.2, 10};
    TokenBucket blocksAway;  // movement; ServerSettings::maxSpeed

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
    std::uint64_t write = 0;  // ServerFile::durable(); 0: nothing was written
    Done done;
};

// Of a player who left: its steps to undo are kept for a while, and what it may do does not begin anew.
struct FormerClient {
    Time at;
    ClientBuckets buckets;
};

struct ServerClient {
    enum class Stage : std::uint8_t { Hello, Login, Password, Proof, Playing, Closed };

    ServerClient(ConnectionId number, double maxSpeed) : id(number), buckets(maxSpeed) {}

    ConnectionId id;
    std::string address;  // for the log
    Bytes channel;        // the connection's exported keying material
    Nonce nonce{};
    Stage stage = Stage::Hello;
    Time openedAt{}, heardAt{};
    ClientBuckets buckets;

    // From Login on.
    std::string name;
    PublicKey key{};

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

// What a server is made of; everything outlives it.
struct ServerParts {
    game::Session& session;
    ServerFile& file;
    People& people;
    std::string program;           // and its version
    WorldFingerprint fingerprint;  // of the session's world
};

// In ServerFile's texts; empty: none is needed.
constexpr const char* kPasswordText = "password";

// Tiles that the store's thread wrote.
struct WrittenTiles {
    std::mutex mutex;
    std::vector<world::ChunkPos> tiles;
};

// How far the world's own file is behind the history.
struct ServerHistory {
    std::int64_t newest = 0;      // number of an edit
    std::uint64_t lastWrite = 0;  // of that edit; ServerFile::durable()
    std::int64_t saved = 0;       // all edits up to this one are in the world's file
    struct SavePoint {
        std::int64_t edit = 0;
        store::SaveNumber save = 0;
    };
    std::optional<SavePoint> saving;  // the store has it, and writes
    Time nextSave{};
};

// A roll-back that goes on tick by tick, for the chunks have to be loaded.
struct RollbackPart {
    world::ChunkPos chunk;
    std::vector<RolledBack> blocks;
};

struct WaitingPassword {
    ConnectionId client = 0;
    std::string password;
};
// A password that a worker compares.
struct PasswordCheck {
    ConnectionId client = 0;
    base::JobHandle job;
    std::shared_ptr<bool> fits = std::make_shared<bool>(false);
};

struct ServerState {
    ServerState(const ServerParts& serverParts, const ServerSettings& serverSettings)
        : session(serverParts.session),
          file(serverParts.file),
          people(serverParts.people),
          program(serverParts.program),
          settings(serverSettings),
          edited({session.generators(), session.store(), session.world(), jobs}) {}

    game::Session& session;
    ServerFile& file;
    People& people;
    std::string program;
    ServerSettings settings;

    WorldFingerprint world;
    SamplePositions samples{};
    SampleDigests digests{};
    world::Pose spawn;
    std::string passwordHash;  // empty: none is needed

    std::map<ConnectionId, ServerClient> clients;
    std::unordered_map<game::PlayerId, ConnectionId> playing;
    std::map<std::string, TokenBucket> newPlayers;  // of an address, since it had its last
    std::unordered_map<game::PlayerId, FormerClient> left;
    std::uint64_t tick = 0;
    Time now{};

    EditedChunks edited;
    std::map<world::ChunkPos, std::vector<world::BlockIndex>> changed;  // since the last tick
    ServerHistory history;
    std::shared_ptr<WrittenTiles> writtenTiles = std::make_shared<WrittenTiles>();
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> tilesToTell;  // they changed
    std::vector<world::ChunkPos> liveChunks;  // where plants grow and liquids flow
    std::deque<RollbackPart> rollbacks;
    std::optional<PasswordCheck> passwordCheck;
    std::deque<WaitingPassword> passwordQueue;
    bool isStopping = false;

    base::JobSystem jobs{1};  // for differences and passwords; ends before what they use
};

}  // namespace terrane::net
