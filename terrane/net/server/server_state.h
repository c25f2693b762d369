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
#include <vector>

#include "terrane/base/job_system.h"
#include "terrane/game/permissions.h"
#include "terrane/game/session.h"
#include "terrane/net/server/edit_log.h"
#include "terrane/net/server/edited_chunks.h"
#include "terrane/net/server/known_players.h"
#include "terrane/net/server/place_owners.h"
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

// The parts of a server; all of them outlive it.
struct ServerParts {
    game::Session& session;
    ServerRecords& records;
    KnownPlayers& knownPlayers;
    std::string program;           // and its version
    WorldFingerprint fingerprint;  // of the session's world
    std::vector<OfferedPack> packs = {};
};

// Tiles written by the store's thread.
struct WrittenTiles {
    std::mutex mutex;
    std::vector<world::ChunkPos> tiles;
};

// Progress of saving edits to the world's store. `newest` and `saved` are 0 if the world is shared: see
// newestEdit() and SharingState.
struct ServerHistory {
    std::int64_t newest = 0;      // number of the newest edit
    std::uint64_t lastWrite = 0;  // number of the last write; see ServerRecords::durable()
    std::int64_t saved = 0;       // all edits up to this one are in the store
    struct SavePoint {
        std::int64_t edit = 0;
        store::SaveNumber save = 0;
    };
    std::optional<SavePoint> saving;  // being written by the store
    Time nextSave{};
};

// A rollback in one chunk. Rollbacks run over several ticks, since their chunks must be loaded.
struct RollbackPart {
    world::ChunkPos chunk;
    std::vector<RolledBack> blocks;
};

struct WaitingPassword {
    ConnectionId client = 0;
    std::string password;
};
// A password check on a worker.
struct PasswordCheck {
    ConnectionId client = 0;
    base::JobHandle job;
    std::shared_ptr<bool> fits = std::make_shared<bool>(false);
};

struct ServerState {
    ServerState(const ServerParts& serverParts, const ServerSettings& serverSettings)
        : session(serverParts.session),
          records(serverParts.records),
          knownPlayers(serverParts.knownPlayers),
          program(serverParts.program),
          packs(serverParts.packs),
          settings(serverSettings),
          placeOwners(serverParts.records),
          edited({session.generators(), session.store(), session.world(), jobs}) {}

    game::Session& session;
    ServerRecords& records;
    KnownPlayers& knownPlayers;
    std::string program;
    std::vector<OfferedPack> packs;
    ServerSettings settings;
    PlaceOwners placeOwners;

    WorldFingerprint world;
    SamplePositions samples{};
    SampleDigests digests{};
    world::Pose spawn;
    std::string passwordHash;  // empty: no password

    std::map<ConnectionId, ServerClient> clients;
    std::unordered_map<game::PlayerId, ConnectionId> playing;
    AddressBuckets newPlayers, chatOfAddress;
    std::unordered_map<game::PlayerId, FormerClient> left;
    std::uint64_t tick = 0;
    Time now{};

    EditedChunks edited;
    std::map<world::ChunkPos, std::vector<world::BlockIndex>> changed;  // since the last tick
    ServerHistory history;
    SharingState sharing;
    std::shared_ptr<WrittenTiles> writtenTiles = std::make_shared<WrittenTiles>();
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> tilesToTell;  // changed tiles
    std::vector<world::ChunkPos> liveChunks;  // where plants grow and liquids flow
    std::deque<RollbackPart> rollbacks;
    std::optional<PasswordCheck> passwordCheck;
    std::deque<WaitingPassword> passwordQueue;
    bool isStopping = false;
    // Called with chunks whose blocks changed, and with stored tiles that changed with them; for maps. May be
    // empty.
    std::function<void(std::span<const world::ChunkPos>)> onChanged;

    base::JobSystem jobs{1};  // for differences and passwords; destroyed first
};

}  // namespace terrane::net
