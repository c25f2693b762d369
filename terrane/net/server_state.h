// All that a server has while it runs: plain data, without sockets. server.h drives it, server_*.h work on
// it, each on one subject. On the server's thread.
#pragma once

#include <chrono>
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
#include "terrane/game/session.h"
#include "terrane/net/edit_log.h"
#include "terrane/net/edited_chunks.h"
#include "terrane/net/people.h"
#include "terrane/net/server_client.h"
#include "terrane/net/server_settings.h"
#include "terrane/net/server_sharing.h"

namespace terrane::net {

constexpr std::chrono::milliseconds kServerTick{50};

// A content pack of the world, as clients that lack it get it.
struct OfferedPack {
    PackOffer offer;
    std::shared_ptr<const Bytes> archive;
};

// What a server is made of; everything outlives it.
struct ServerParts {
    game::Session& session;
    ServerRecords& records;
    People& people;
    std::string program;           // and its version
    WorldFingerprint fingerprint;  // of the session's world
    std::vector<OfferedPack> packs = {};
};

// Tiles that the store's thread wrote.
struct WrittenTiles {
    std::mutex mutex;
    std::vector<world::ChunkPos> tiles;
};

// How far the world's own file is behind the history.
struct ServerHistory {
    std::int64_t newest = 0;      // number of an edit
    std::uint64_t lastWrite = 0;  // of that edit; ServerRecords::durable()
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
          records(serverParts.records),
          people(serverParts.people),
          program(serverParts.program),
          packs(serverParts.packs),
          settings(serverSettings),
          edited({session.generators(), session.store(), session.world(), jobs}) {}

    game::Session& session;
    ServerRecords& records;
    People& people;
    std::string program;
    std::vector<OfferedPack> packs;
    ServerSettings settings;

    WorldFingerprint world;
    SamplePositions samples{};
    SampleDigests digests{};
    world::Pose spawn;
    std::string passwordHash;  // empty: none is needed

    std::map<ConnectionId, ServerClient> clients;
    std::unordered_map<game::PlayerId, ConnectionId> playing;
    std::map<std::string, base::TokenBucket> newPlayers;  // of a network, since it had its last
    std::unordered_map<game::PlayerId, FormerClient> left;
    std::uint64_t tick = 0;
    Time now{};

    EditedChunks edited;
    std::map<world::ChunkPos, std::vector<world::BlockIndex>> changed;  // since the last tick
    ServerHistory history;
    SharingState sharing;
    std::shared_ptr<WrittenTiles> writtenTiles = std::make_shared<WrittenTiles>();
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> tilesToTell;  // they changed
    std::vector<world::ChunkPos> liveChunks;  // where plants grow and liquids flow
    std::deque<RollbackPart> rollbacks;
    std::optional<PasswordCheck> passwordCheck;
    std::deque<WaitingPassword> passwordQueue;
    bool isStopping = false;
    // Told of chunks whose blocks changed, and of tiles of the store that changed with them; for maps. May be
    // empty.
    std::function<void(std::span<const world::ChunkPos>)> onChanged;

    base::JobSystem jobs{1};  // for differences and passwords; ends before what they use
};

}  // namespace terrane::net
