// A server's world in a client: a session whose chunks the client generates and whose edits the server tells.
// Own edits show at once, and are taken back where the server decides otherwise. Without sockets; on the
// world's thread.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "terrane/game/session.h"
#include "terrane/net/client_message.h"
#include "terrane/net/prediction.h"
#include "terrane/net/remote_store.h"
#include "terrane/net/server_message.h"

namespace terrane::net {

// Another player in sight.
struct SeenPlayer {
    game::PlayerId id = game::kNoPlayer;
    std::string name;
    world::Pose pose;          // as told last
    std::uint64_t moves = 0;   // how often its pose was told
    std::uint64_t swings = 0;  // how often its arm swung
};

struct ChatLine {
    std::string name;  // empty: the server
    std::string text;
};

// What the server decided on a command that could not be shown at once, or that it refused.
using Decided = std::variant<game::EditResult, game::BuildOutcome, game::TakenBack>;

class ClientWorld {
  public:
    using Send = std::function<void(const ClientMessage&)>;
    // The session's store is `store`. Both outlive this. From here on the server decides on the session's
    // commands (game::Authority).
    ClientWorld(game::Session& session, RemoteStore& store, Send send);
    ~ClientWorld();
    ClientWorld(const ClientWorld&) = delete;
    ClientWorld& operator=(const ClientWorld&) = delete;

    // A message of the server, Joined or after it. Joined again after a cut: all is told again.
    void onMessage(const ServerMessage& message);
    // The connection is gone: what the server did not decide on is taken back.
    void onCut();

    void say(const std::string& text);

    // Tells the server where the player is and what it looks at, and gives late changes to chunks that were
    // being loaded. Call each frame.
    void update(const world::Pose& pose, int viewDistance, int horizon,
                std::chrono::steady_clock::time_point now);

    bool isViewComplete() const { return isViewComplete_; }
    const std::map<std::uint16_t, SeenPlayer>& players() const { return players_; }
    const std::optional<PlayerList>& playerList() const { return playerList_; }

    // What came since the last call.
    std::vector<ChatLine> takeChat();
    std::vector<Decided> takeDecided();
    // Where the server put the player, where it did not believe a move.
    std::optional<world::Pose> takeCorrection();
    std::size_t undecidedCount() const { return waiting_.size(); }

  private:
    struct WaitingDecision {
        CommandNumber number = 0;
        enum class Kind : std::uint8_t { Edit, Build, TakeBack } kind = Kind::Edit;
    };
    void sendEdit(const game::EditCommand& command, std::span<const game::ChangedBlock> changed);
    void sendBuild(const game::BuildChange& change);
    void sendTakeBack(game::HistoryWay way);
    void take(const Joined& joined);
    void take(const ChunkEdits& edits);
    void take(const BlocksChanged& changed);
    void take(const Done& done);
    void take(const Poses& poses);
    void take(const auto&) {}

    void show(std::span<const world::PlacedBlock> blocks);
    void showChunk(world::ChunkPos pos, const ChunkDifference& blocks);
    ChunkDifference replaceDifference(world::ChunkPos pos, const ChunkDifference& difference);
    void showLateChunks();
    bool isLoading(world::ChunkPos pos) const;

    game::Session& session_;
    RemoteStore& store_;
    Send send_;
    Prediction prediction_;
    std::optional<Joined> joined_;
    CommandNumber lastCommand_ = 0;
    std::deque<WaitingDecision> waiting_;
    // Of chunks that changed while they were loaded.
    std::unordered_map<world::ChunkPos, ChunkDifference, world::ChunkPosHash> late_;
    bool isConnected_ = false, isViewComplete_ = false;

    std::optional<WirePose> toldPose_;
    std::optional<View> toldView_;
    std::chrono::steady_clock::time_point nextMove_{};

    std::map<std::uint16_t, SeenPlayer> players_;  // by slot
    std::map<std::uint16_t, WirePose> playerPoses_;
    std::optional<PlayerList> playerList_;
    std::vector<ChatLine> chat_;
    std::vector<Decided> decided_;
    std::optional<world::Pose> correction_;
};

}  // namespace terrane::net
