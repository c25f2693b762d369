// The state of a running server: plain data, without sockets. server.h drives it; each server_*.h works on
// one part of it. On the server's thread.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "terrane/base/job_system.h"
#include "terrane/game/permissions.h"
#include "terrane/game/player_items.h"
#include "terrane/game/session.h"
#include "terrane/net/server/edit_log.h"
#include "terrane/net/server/edited_chunks.h"
#include "terrane/net/server/known_players.h"
#include "terrane/net/server/place_owners.h"
#include "terrane/net/server/server_backup.h"
#include "terrane/net/server/server_client.h"
#include "terrane/net/sharing/server_sharing.h"

namespace terrane::net {

// Settings of a server. Plain values.
struct ServerSettings {
    std::string welcome;  // a line sent to players who join; empty: none
    std::size_t maxPlayers = 100;
    int maxViewDistance = 32;                   // radius in chunks in which a player receives edits
    std::size_t maxPlayersOfAddress = 20;       // at a time, except from this machine
    double newPlayersPerHour = 100;             // per address, except from this machine
    double maxSpeed = 120;                      // blocks per second; flying reaches 60, falling 55
    int spawnRadius = 0;                        // blocks around the spawn where new players appear
    game::Role newcomers = game::Role::Player;  // Guest: may look and chat only
    std::optional<game::Mode> mode = {};        // of the world from now on; none: as before
    double dayMinutes = 20;
    std::size_t maxFillBlocks = 65536;         // in one command
    std::size_t maxPlacesOfPlayer = 5;         // named places; operators are not limited
    std::size_t maxUnsentBytes = 4 << 20;      // for a client that does not read
    std::chrono::seconds loginWithin{10};      // from connecting to joining
    std::chrono::seconds silentAfter{20};      // time without a message of a player
    std::chrono::seconds keepHistoryFor{600};  // undo steps of a player who left
};

constexpr std::chrono::milliseconds kServerTick{50};

// A content pack of the world, as sent to clients that lack it.
struct OfferedPack {
    PackOffer offer;
    std::shared_ptr<const Bytes> archive;
};

// Tiles written by the store's thread, which calls SessionParts::tileListener.
struct WrittenTiles {
    std::mutex mutex;
    std::vector<world::ChunkPos> tiles;
};

// What every client is told of the server.
struct ServerOffer {
    std::string program;           // and its version
    WorldFingerprint fingerprint;  // of the session's world
    std::vector<OfferedPack> packs;
    SamplePositions samples{};
    SampleDigests digests{};
    world::Pose spawn = {};
};

// The parts of a server; all of them outlive it.
struct ServerParts {
    game::Session& session;
    ServerRecords& records;
    KnownPlayers& knownPlayers;
    std::shared_ptr<WrittenTiles> tiles;
    ServerOffer offer;
};

// A player on another server of the world.
struct PlayerElsewhere {
    PlayerAt at;
    Time heardAt{};
};

// The connections of a server, and all players.
struct ServerClients {
    const ServerSettings& settings;
    KnownPlayers& known;
    SharedWorld* shared;  // null: no other servers
    game::Events& events;
    std::uint64_t tick = 0;
    Time now{};  // time of the last tick or message
    std::map<ConnectionId, ServerClient> all = {};
    std::unordered_map<game::PlayerId, ConnectionId> playing = {};
    std::unordered_map<game::PlayerId, FormerClient> former = {};  // players who left
    std::unordered_map<game::PlayerId, PlayerElsewhere> elsewhere = {};
    AddressBuckets newPlayers = {}, chatOfAddress = {};  // rate limits
};

// The password for joining, and its checks, one after another on a worker.
struct ServerPassword {
    struct Waiting {
        ConnectionId client = 0;
        std::string password;
    };
    struct Check {
        ConnectionId client = 0;
        base::JobHandle job;
        std::shared_ptr<bool> fits = std::make_shared<bool>(false);
    };

    std::string hash;  // empty: no password
    std::optional<Check> running;
    std::deque<Waiting> queue;
};

// Edited chunks and tiles, and who is told of their changes.
struct ServerEdits {
    EditedChunks chunks;
    std::shared_ptr<WrittenTiles> writtenTiles;
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> tilesToTell = {};
    // Called with chunks whose blocks changed, and with stored tiles that changed with them; for maps. May be
    // empty.
    std::function<void(std::span<const world::ChunkPos>)> onChanged = {};
};

// Blocks that changed, by chunk; in any order, some several times.
using ChangedIndices = std::map<world::ChunkPos, std::vector<world::BlockIndex>>;

// A part of a rollback in one chunk. Rollbacks run over several ticks, since their chunks must be loaded:
// first all blocks are set, then the rules run for those that changed, so that nothing falls which still gets
// its ground back.
struct RollbackPart {
    world::ChunkPos chunk;
    std::vector<game::ChangedBlock> blocks;  // to set
    std::vector<world::BlockPos> settling;   // for which the rules are to run
};

// Stamps of edits, milliseconds since 1970, that never go back: by the system's clock, but at least as late
// as the last stamp and the time since then on the steady clock. A wrong date thus moves stamps once, and
// durations between them stay right, also if the clock is set while the server runs.
struct StampClock {
    std::function<std::int64_t()> systemMs = nowMs;  // the system's clock
    std::int64_t newestMs = 0;                       // the last stamp, at first that of the newest edit
    Time newestAt{};                                 // when it was given; unknown at first
    bool isBehind = false;                           // the system's clock is; warned of it

    // Call when the server begins to run, so that time without edits counts.
    void begin(Time now) {
        if (newestAt == Time{}) newestAt = now;
    }
    std::int64_t at(Time now);
    // Takes a stamp of another server of the world, so that later ones of this server are not before it.
    void hear(std::int64_t stampMs, Time now);
};

// The edit history, and the progress of saving its edits to the world's store. `newest` and `saved` are 0 if
// the world is shared: see SharingState.
struct ServerHistory {
    ServerRecords& records;
    std::int64_t newest = 0;      // number of the newest edit
    std::uint64_t lastWrite = 0;  // number of the last write; see ServerRecords::durable()
    std::int64_t saved = 0;       // all edits up to this one are in the store
    struct SavePoint {
        std::int64_t edit = 0;
        store::SaveNumber save = 0;
    };
    std::optional<SavePoint> saving = {};  // being written by the store
    Time nextSave{};
    StampClock stamps = {};
    std::deque<RollbackPart> rollbacks = {};
    std::size_t rolledBack = 0, keptByRollbacks = 0;  // blocks of the running rollbacks
};

// Named places, in the metadata of the world.
struct ServerPlaces {
    store::ChunkStore& store;
    SharedWorld* shared;  // null: no other servers
    const ServerSettings& settings;
    PlaceOwners owners;
    std::deque<std::pair<store::SaveNumber, PlaceChange>> untold = {};  // own changes, not saved yet
};

struct ServerState {
    ServerState(const ServerParts& parts, const ServerSettings& serverSettings)
        : session(parts.session),
          settings(serverSettings),
          offer(parts.offer),
          clients{settings, parts.knownPlayers, parts.records.shared(), session.events},
          history{parts.records},
          edits{EditedChunks({session.generators(), session.store(), session.world(), jobs}), parts.tiles},
          places{session.store(), parts.records.shared(), settings, PlaceOwners(parts.records)} {}

    game::Session& session;
    const ServerSettings settings;
    const ServerOffer offer;
    ServerClients clients;
    ServerPassword password;
    ServerHistory history;
    ServerEdits edits;
    ChangedIndices changed;  // since clients were told of changes
    ServerPlaces places;
    SharingState sharing;
    ServerBackup backup;
    std::vector<world::ChunkPos> liveChunks;  // where plants grow and liquids flow
    bool isStopping = false;
    std::map<game::PackId, game::PlayerId> packPlayers = {};  // see packIdOf()
    std::vector<game::Subscription> subscriptions = {};

    base::JobSystem jobs{1};  // for differences and passwords; destroyed first
};

}  // namespace terrane::net
