// A player without a screen: it walks, builds, and notes what the server tells. An example of a client, and
// what load tests are made of. Plain bookkeeping on one thread; all bots share a BotWorld.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "apps/terrane/bots/bot_land.h"
#include "terrane/net/client_link.h"

namespace terrane::app {

using BotTime = std::chrono::steady_clock::time_point;

enum class BotBehaviour : std::uint8_t {
    Walk,   // some 50 blocks around the place where each begins; some build
    Build,  // the same, and all build
    Crowd,  // all within 10 blocks of where the first one began; some build
};

struct BotSettings {
    std::vector<net::ServerAddress> servers;  // of one world; bots take turns
    std::string name = "bot";                 // and a number
    std::string password;
    std::string keyFolder;  // where each bot's key is kept; empty: new keys
    BotBehaviour behaviour = BotBehaviour::Walk;
    double builders = 0.1;      // share of bots that build, but for Build
    double editsPerSecond = 1;  // of each that builds
    int viewDistance = 8;
};

// What all bots know and count.
struct BotWorld {
    explicit BotWorld(ClientPacks serverPacks) : land(std::move(serverPacks)) {}

    BotLand land;
    std::optional<world::Pose> crowd;  // where the first bot began

    struct SentEdit {
        BotTime at;
        game::PlayerId by = game::kNoPlayer;
        std::string server;  // that it was said to
    };
    // By another bot; where there are several servers, by one on another server.
    std::unordered_map<world::BlockPos, SentEdit, world::BlockPosHash> unseen;
    // Blocks as decided last, without those of which that is not known because the connection went.
    std::map<world::BlockPos, world::BlockId> acknowledged;
    std::set<world::BlockPos> unknown;                                     // those
    std::unordered_map<world::BlockPos, int, world::BlockPosHash> owners;  // the bot that alone builds there
    std::vector<double> joinedKb, joinedMs;  // until all edits in sight are there, from the first byte
    std::vector<double> seenMs;              // from the edit until another bot is told
    std::vector<double> decidedMs;           // until it is durable
    std::uint64_t edits = 0, refused = 0, corrections = 0, cuts = 0, joins = 0;
};

class Bot {
  public:
    Bot(boost::asio::io_context& context, BotWorld& world, const BotSettings& settings, int number);

    // Moves, builds and tells the server. Some times a second.
    void update(BotTime now);
    void leave() { link_.leave(); }

    const net::ClientLink& link() const { return link_; }
    // Blocks on which the server has not decided yet.
    std::vector<world::BlockPos> undecided() const;

  private:
    struct Pending {
        BotTime at;
        world::BlockPos pos;
        world::BlockId id = world::kAir;
    };
    void onMessage(const net::ServerMessage& message);
    void onJoined(const net::Joined& joined);
    void onViewComplete();
    void onBlocks(const net::BlocksChanged& changed);
    void onDone(const net::Done& done);
    void walk(double seconds);
    void chooseGoal();
    void build(BotTime now);
    void tellView();

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
    net::CommandNumber lastCommand_ = 0;
    std::map<net::CommandNumber, Pending> pending_;
    net::ClientLink link_;  // last: its events reach the rest
};

}  // namespace terrane::app
