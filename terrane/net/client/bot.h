// A simulated player: it walks, builds, and records what the server sends. For load tests, and an example of
// a client. Runs on one thread; all bots share a BotWorld.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/gen/generator.h"
#include "terrane/net/client/client_link.h"
#include "terrane/net/client/client_packs.h"
#include "terrane/net/wire/server_message.h"
#include "terrane/net/wire/world_proof.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::net {

// The ground that bots walk on: generated terrain without edits. Shared by all bots. One thread.
class BotLand {
  public:
    explicit BotLand(ClientPacks serverPacks) : packs(std::move(serverPacks)) {}

    ClientPacks packs;  // of the server's world

    // The answer to a server's offer, cached for the same offer. Fails if this program generates another
    // world.
    [[nodiscard]] base::Result<SampleDigests> prove(const WorldOffer& offer);
    // The height of the highest block of a column; call after prove(). Generates the chunk at the first
    // request.
    int groundHeight(std::int32_t x, std::int32_t y);
    // Call after prove().
    world::Heights heights() const { return generator_->heights(); }
    // Call after prove().
    const world::BlockRegistry& blocks() const { return *content_.blocks; }

  private:
    pack::Content content_;
    std::unique_ptr<gen::Generator> generator_;
    WorldOffer offer_;
    SampleDigests digests_{};
    // z of the highest block of each column.
    std::unordered_map<world::ChunkPos, std::array<std::int16_t, world::kBlocksPerLayer>, world::ChunkPosHash>
        ground_;
};

using BotTime = std::chrono::steady_clock::time_point;

enum class BotBehaviour : std::uint8_t {
    Walk,   // within 48 blocks of its start; a share of the bots builds
    Build,  // as Walk, and all bots build
    Crowd,  // within 10 blocks of the first bot's start; a share builds
};

struct BotSettings {
    std::vector<ServerAddress> servers;  // of one world; assigned to bots in turn
    std::string name = "bot";            // prefix; a number follows
    std::string password;
    std::string keyFolder;  // keeps each bot's key; empty: new keys in each run
    BotBehaviour behaviour = BotBehaviour::Walk;
    double builders = 0.1;      // share of bots that build; not used by Build
    double editsPerSecond = 1;  // per bot that builds
    int viewDistance = 8;
    std::string program = "bot";  // name and version that servers see
};

// State and statistics shared by all bots.
struct BotWorld {
    explicit BotWorld(ClientPacks serverPacks) : land(std::move(serverPacks)) {}

    BotLand land;
    std::optional<world::Pose> crowd;  // start of the first bot

    struct SentEdit {
        BotTime at;
        game::PlayerId by = game::kNoPlayer;
        std::string server;  // that the bot is connected to
    };
    // Edits that no other bot has received yet; with several servers, no bot on another server.
    std::unordered_map<world::BlockPos, SentEdit, world::BlockPosHash> unseen;
    // Blocks as last acknowledged, without those in `unknown`.
    std::map<world::BlockPos, world::BlockId> acknowledged;
    std::set<world::BlockPos> unknown;                                     // unanswered at a disconnect
    std::unordered_map<world::BlockPos, int, world::BlockPosHash> owners;  // the only bot that builds there
    std::vector<double> joinedKb, joinedMs;  // from the connection to the complete view
    std::vector<double> seenMs;              // from an edit until another bot receives it
    std::vector<double> decidedMs;           // from an edit until the answer that it is durable
    std::uint64_t edits = 0, refused = 0, corrections = 0, cuts = 0, joins = 0;
};

// The key of a bot: loaded from BotSettings::keyFolder or created there; a new one without a folder.
[[nodiscard]] base::Result<PlayerKey> botKey(const BotSettings& settings, int number);

class Bot {
  public:
    Bot(boost::asio::io_context& context, BotWorld& world, const BotSettings& settings, int number,
        const PlayerKey& key);

    // Moves, builds and sends to the server. Call several times per second.
    void update(BotTime now);
    void leave() { link_.leave(); }

    const ClientLink& link() const { return link_; }
    // Positions of edits that the server has not answered yet.
    std::vector<world::BlockPos> undecided() const;

  private:
    struct Pending {
        BotTime at;
        world::BlockPos pos;
        world::BlockId id = world::kAir;
    };
    void onMessage(const ServerMessage& message);
    void onJoined(const Joined& joined);
    void onViewComplete();
    void onBlocks(const BlocksChanged& changed);
    void onDone(const Done& done);
    void walk(double seconds);
    void chooseGoal();
    void build(BotTime now);
    void sendView();

    BotWorld& world_;
    const BotSettings& settings_;
    std::mt19937 random_;
    int number_ = 0;
    bool builds_ = false, wasJoined_ = false, knowsView_ = false;
    BotTime beganAt_ = std::chrono::steady_clock::now(), moved_{}, builtAt_{};
    game::PlayerId player_ = game::kNoPlayer;
    world::Pose pose_, home_;
    glm::dvec2 goal_{0};
    std::optional<world::ChunkPos> toldView_;
    CommandNumber lastCommand_ = 0;
    std::map<CommandNumber, Pending> pending_;
    ClientLink link_;  // last: its events reach the rest
};

}  // namespace terrane::net
