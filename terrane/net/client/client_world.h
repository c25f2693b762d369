// A server's world on the client: a session whose chunks the client generates and whose edits the server
// sends. Own edits are applied at once and reverted if the server decides otherwise. Without sockets; on the
// world's thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <variant>
#include <vector>

#include "terrane/game/session.h"
#include "terrane/net/client/remote_session.h"
#include "terrane/net/wire/client_message.h"
#include "terrane/net/wire/server_message.h"
#include "terrane/world/world.h"

namespace terrane::net {

// Client-side prediction: remembers which blocks show an own edit that the server has not decided yet, and
// the server's value of them. Plain bookkeeping; the world's thread.
class Prediction {
  public:
    // The client applied command `number`, larger than all before. `before`: the changed blocks with their
    // previous values.
    void predict(std::uint32_t number, std::span<const world::PlacedBlock> before);

    // Takes block values from the server. Returns the blocks without a pending command: they are to be shown.
    [[nodiscard]] std::vector<world::PlacedBlock> takeIn(std::span<const world::PlacedBlock> blocks);

    // The server decided on all commands up to `number` and sent their changes. Returns the blocks without
    // further pending commands, with the server's values.
    [[nodiscard]] std::vector<world::PlacedBlock> settle(std::uint32_t number);
    // The connection was lost: no pending command will be decided. Returns all pending blocks with the
    // server's last values.
    [[nodiscard]] std::vector<world::PlacedBlock> settleAll();

    std::size_t blockCount() const { return ahead_.size(); }  // with pending commands

  private:
    struct Ahead {
        world::BlockValue server;  // the server's value
        std::uint32_t last = 0;    // newest command that changed the block
    };
    std::unordered_map<world::BlockPos, Ahead, world::BlockPosHash> ahead_;
};

// Another player in sight.
struct SeenPlayer {
    game::PlayerId id = game::kNoPlayer;
    std::string name;
    world::Pose pose;          // as received last
    std::uint64_t moves = 0;   // number of poses received
    std::uint64_t swings = 0;  // number of arm swings
};

struct ChatLine {
    std::string name;  // empty: sent by the server
    std::string text;
};

struct DecidedTakeBack {
    game::HistoryWay way = game::HistoryWay::Undo;
    game::UndoResult result;
};

// The server's decision on a command that was not predicted, or that it refused.
using Decided = std::variant<game::EditResult, game::BuildOutcome, DecidedTakeBack>;

class ClientWorld {
  public:
    using Send = std::function<void(const ClientMessage&)>;
    // `store` is the session's store. Both outlive this. From here on the server decides on the session's
    // commands (game::Authority).
    ClientWorld(game::Session& session, RemoteStore& store, Send send);
    ~ClientWorld();
    ClientWorld(const ClientWorld&) = delete;
    ClientWorld& operator=(const ClientWorld&) = delete;

    // Handles Joined and all messages after it. A second Joined, after a lost connection, resets the view:
    // all edits in it are sent again, and those that the server has lost disappear once the view is complete.
    void onMessage(const ServerMessage& message);
    // The connection was lost: reverts commands that the server did not decide on.
    void onCut();

    void say(const std::string& text);

    // Sends the player's pose and view to the server, and applies late changes to chunks that were being
    // loaded. Call each frame.
    void update(const world::Pose& pose, int viewDistance, int horizon,
                std::chrono::steady_clock::time_point now);

    bool isViewComplete() const { return isViewComplete_; }
    const std::map<std::uint16_t, SeenPlayer>& players() const { return players_; }
    const std::optional<PlayerList>& playerList() const { return playerList_; }

    // Chat lines and decisions received since the last call.
    std::vector<ChatLine> popChat();
    std::vector<Decided> popDecided();
    // The pose that the server set because it rejected a move.
    std::optional<world::Pose> popCorrection();
    std::size_t undecidedCount() const { return waiting_.size(); }

  private:
    struct WaitingDecision {
        CommandNumber number = 0;
        enum class Kind : std::uint8_t { Edit, Build, Undo, Redo, Item } kind = Kind::Edit;
    };
    void sendEdit(const game::EditCommand& command, std::span<const game::ChangedBlock> changed);
    void sendBuild(const game::BuildChange& change);
    void sendTakeBack(game::HistoryWay way);
    void sendAction(const game::ItemAction& action);
    void onItems(const Items& items);
    void onJoined(const Joined& joined);
    void onChunkEdits(const ChunkEdits& edits);
    void onBlocksChanged(const BlocksChanged& changed);
    void onDone(const Done& done);
    void onPoses(const Poses& poses);

    void show(std::span<const world::PlacedBlock> blocks);
    void showChunk(world::ChunkPos pos, const ChunkDifference& blocks);
    void setTile(world::ChunkPos pos, const ChunkDifference& blocks);
    void noteToldView(const View& view);
    void dropUnconfirmed();
    ChunkDifference replaceDifference(world::ChunkPos pos, const ChunkDifference& difference);
    void showLateChunks();
    bool isOnTheWay(world::ChunkPos pos) const;

    game::Session& session_;
    RemoteStore& store_;
    Send send_;
    Prediction prediction_;
    int maxViewDistance_ = 0;  // of the server
    // Chunks and tiles with edits from before the connection was lost, of which the server has not told
    // since.
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> unconfirmed_;
    bool mayDropUnconfirmed_ = false;  // since the view was complete
    CommandNumber lastCommand_ = 0;
    std::deque<WaitingDecision> waiting_;
    // Changes that arrived for chunks while they were being loaded.
    std::unordered_map<world::ChunkPos, ChunkDifference, world::ChunkPosHash> late_;
    bool isConnected_ = false, isViewComplete_ = false;

    std::optional<WirePose> toldPose_;
    std::optional<View> toldView_;
    View completeView_;  // what a ViewComplete that comes next is certainly about
    std::chrono::steady_clock::time_point nextMove_{};
    int lowest_ = world::kLowestBottom;  // View::lowest

    std::map<std::uint16_t, SeenPlayer> players_;  // by slot
    std::map<std::uint16_t, WirePose> playerPoses_;
    std::optional<PlayerList> playerList_;
    std::vector<ChatLine> chat_;
    std::vector<Decided> decided_;
    std::optional<world::Pose> correction_;
};

}  // namespace terrane::net
