// Several servers of one world, as one of them sees it: own edits that are not decided yet, those of others,
// players and time elsewhere (shared_world.h). Nothing happens where the records are this server's alone. On
// the server's thread.
//
// The store of the world is behind the history: what it lacks is the tail, which is kept here and added to
// each chunk that is loaded. A chunk is saved by the servers that have changes in it, once all of its edits
// are decided.
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

#include "terrane/net/server_client.h"
#include "terrane/net/shared_world.h"

namespace terrane::net {

struct ServerState;

struct SharingState {
    SharedWorld* shared = nullptr;  // null: nothing is shared

    // Own writes that are not decided, with the blocks as the history has them without these.
    std::map<std::uint64_t, std::vector<LoggedEdit>> undecided;
    struct Settled {
        world::BlockValue value;
        int undecided = 0;  // own writes that change the block
    };
    std::unordered_map<world::BlockPos, Settled, world::BlockPosHash> settled;
    // How many own writes of a chunk are. The pipeline looks here to its end, which is after the server's.
    using ChunkCounts = std::unordered_map<world::ChunkPos, int, world::ChunkPosHash>;
    std::shared_ptr<ChunkCounts> undecidedChunks = std::make_shared<ChunkCounts>();
    std::set<std::uint64_t> refused;  // writes; whoever made them is not told yet

    // Edits that the store may lack, in ascending order.
    struct TailEdit {
        std::int64_t number = 0;
        ChunkDifference after;
    };
    std::unordered_map<world::ChunkPos, std::vector<TailEdit>, world::ChunkPosHash> tail;
    std::int64_t newest = 0, saved = 0;                 // edits: heard of; in the store, of all servers
    std::deque<std::pair<Time, std::int64_t>> savedAt;  // what `saved` was, for chunks that are being loaded
    std::int64_t ownSaved = 0;                          // up to this one none waits here to be saved
    std::unordered_map<world::ChunkPos, std::int64_t, world::ChunkPosHash> firstUnsaved;  // edit of a chunk

    struct OtherAt {
        PlayerAt at;
        Time heardAt{};
    };
    std::unordered_map<game::PlayerId, OtherAt> players;  // on other servers
    std::unordered_map<game::PlayerId, WirePose> toldPoses;
    std::vector<OtherServer> servers;  // that are there
    // Servers that are gone without saving: what they left is loaded, some chunks a tick, and saved.
    struct Orphans {
        std::int64_t server = 0, newest = 0;
        std::vector<world::ChunkPos> chunks;        // that are not loaded yet
        std::optional<std::uint64_t> savedBy = {};  // the save that has all of them
    };
    std::deque<Orphans> orphans;
    std::set<std::int64_t> forgotten;  // servers whose orphans are saved; lists of servers may come later
    std::uint64_t savesBegun = 0, savesDone = 0;
    std::deque<std::pair<store::SaveNumber, PlaceChange>> untoldPlaces;  // own, that wait to be saved
    Time nextState{};
};

// Once, before anybody plays.
[[nodiscard]] base::Result<void> beginSharing(ServerState& server);
// An own write, after append().
void noteWrite(ServerState& server, std::uint64_t write, std::vector<LoggedEdit> edits);
// What others did, at the beginning of each tick.
void takeNews(ServerState& server);
// After each update of the pipeline: adds the tail to chunks that were loaded.
void completeLoaded(ServerState& server);
// Tells others of players and of this server, and lets go of what is saved. In each tick.
void keepSharing(ServerState& server);
// Saves, and notes what is saved; in place of keepSaving().
void keepSharedSaved(ServerState& server);
// Whether time may pass in a chunk here.
bool mayGrow(const ServerState& server, world::ChunkPos chunk);
// Of the chunks that live here: the leases that are wanted.
void wantRegions(ServerState& server, std::span<const world::ChunkPos> chunks);

}  // namespace terrane::net
