// The state of a server that shares its world with others (shared_world.h): own edits that are not decided
// yet, edits of other servers, their players and time. Does nothing if the records are not shared. On the
// server's thread.
//
// The world's store is behind the history: the edits that it lacks are the tail, which is kept here and
// applied to each chunk that is loaded. A chunk is saved by the servers that have changes in it, once all of
// its edits are decided.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "terrane/game/session.h"
#include "terrane/net/server/edited_chunks.h"
#include "terrane/net/server/server_client.h"
#include "terrane/net/sharing/shared_world.h"

namespace terrane::net {

struct ServerClients;
struct ServerEdits;
struct ServerPlaces;

struct SharingState {
    SharedWorld* shared = nullptr;  // null: nothing is shared

    // Own undecided writes, and the values of their blocks in the history without these writes.
    std::map<std::uint64_t, std::vector<LoggedEdit>> undecided;
    struct Settled {
        world::BlockValue value;
        int undecided = 0;  // number of own undecided writes that change the block
    };
    std::unordered_map<world::BlockPos, Settled, world::BlockPosHash> settled;
    // Number of own undecided edits per chunk. Shared with the pipeline, which outlives the server.
    using ChunkCounts = std::unordered_map<world::ChunkPos, int, world::ChunkPosHash>;
    std::shared_ptr<ChunkCounts> undecidedChunks = std::make_shared<ChunkCounts>();

    // Edits that the store may lack, ascending.
    struct TailEdit {
        std::int64_t number = 0;
        ChunkDifference after;
    };
    std::unordered_map<world::ChunkPos, std::vector<TailEdit>, world::ChunkPosHash> tail;
    std::int64_t newest = 0, saved = 0;                 // edit numbers: newest known; saved by all servers
    std::deque<std::pair<Time, std::int64_t>> savedAt;  // history of `saved`, for chunks being loaded
    std::int64_t ownSaved = 0;                          // no edit up to this one is unsaved on this server
    std::unordered_map<world::ChunkPos, std::int64_t, world::ChunkPosHash> firstUnsaved;  // number of an edit

    std::unordered_map<game::PlayerId, WirePose> toldPoses;
    std::vector<OtherServer> servers;  // running ones
    // Servers that stopped without saving: their unsaved chunks are loaded, a few per tick, and saved.
    struct Orphans {
        std::int64_t server = 0, newest = 0;
        std::vector<world::ChunkPos> chunks;        // not loaded yet
        std::optional<std::uint64_t> savedBy = {};  // number of the save that includes all of them
    };
    std::deque<Orphans> orphans;
    std::set<std::int64_t> forgotten;  // servers whose orphans are saved; they may still be listed
    std::uint64_t savesBegun = 0, savesDone = 0;
    Time nextState{};
};

// Reads the edits that the store lacks. Call once, before players join.
[[nodiscard]] base::Result<void> beginSharing(SharingState& sharing, ServerRecords& records,
                                              game::Session& session, EditedChunks& edited);
// Call after append() of an own write.
void trackWrite(SharingState& sharing, std::uint64_t write, std::vector<LoggedEdit> edits);
// Applies edits of other servers, and the decisions on own ones, also to the decisions that players wait for.
void applyHistory(SharingState& sharing, game::Session& session, ServerClients& clients, ServerEdits& edits,
                  const SharedChanges& changes);
// Applies changes of players and claims.
void applyPlayers(ServerClients& clients, game::Permissions& permissions, const SharedChanges& changes);
// Drops edits that all servers saved a while ago. Returns the chunks whose stored rows have them now.
std::vector<world::ChunkPos> dropTail(SharingState& sharing, std::int64_t nowSaved, Time now);
// Applies the tail to newly loaded chunks. Call after each update of the pipeline.
void completeLoaded(SharingState& sharing, game::Session& session);
// Tells other servers about players, saved places and this server's state, and saves the chunks of stopped
// servers. Call in each tick.
void updateSharing(SharingState& sharing, const ServerClients& clients, ServerPlaces& places,
                   stream::ChunkPipeline& pipeline);
// Begins a save of all changes. Returns the number up to which no edit is unsaved once it ends.
std::int64_t beginSharedSave(SharingState& sharing, game::Session& session);
// The save that returned `edit` ended.
void endSharedSave(SharingState& sharing, std::int64_t edit);
// The chunks in which time may pass on this server.
std::vector<world::ChunkPos> growingChunks(const SharedWorld* shared,
                                           const std::vector<world::ChunkPos>& chunks);
// Requests the leases of the regions of `chunks`, in which time passes on this server.
void requestRegions(SharedWorld& shared, std::span<const world::ChunkPos> chunks);

}  // namespace terrane::net
