// Players act randomly over slow connections: in the end all of them have the server's world. Deterministic
// for a seed. Add failing seeds here as regression tests.
#include <gtest/gtest.h>

#include <random>

#include "terrane/world/changes/liquid_flow.h"
#include "tests/net/server_fixture.h"

namespace terrane::net {
namespace {

constexpr int kPlayers = 3, kSteps = 1200, kMaxDelay = 12;  // steps are ticks: 0.6 s
// Of each session in a tick: chunks come soon or late.
constexpr int kManyJobs = 12, kFewJobs = 2;
constexpr double kAway = 70;       // blocks from the spawn
constexpr double kStepBlocks = 4;  // 80 blocks a second

// Runs up to `count` jobs.
void runJobs(base::JobSystem& jobs, int count) {
    while (count-- > 0 && jobs.runNext()) continue;
}

// Delays messages by some steps, keeping their order.
template <class Message>
class SlowWay {
  public:
    void add(Message message, int due) {
        ways_.push_back({std::max(due, last_), std::move(message)}), last_ = std::max(due, last_);
    }
    template <class Use>
    void deliver(int step, Use use) {
        while (!ways_.empty() && ways_.front().first <= step) {
            const Message message = std::move(ways_.front().second);
            ways_.pop_front();
            use(message);
        }
    }
    bool isEmpty() const { return ways_.empty(); }
    void clear() { ways_.clear(); }

  private:
    std::deque<std::pair<int, Message>> ways_;
    int last_ = 0;
};

class RandomPlayer {
  public:
    RandomPlayer(TestServer& server, int number, unsigned seed)
        : random_(seed * 100 + static_cast<unsigned>(number)),
          server_(server),
          identity_(testIdentity(fmt::format("Player {}", number))),
          view_(1 + number % 2) {
        auto parts = remoteSessionParts(server.state().offer.fingerprint.identity, ownBlocks(), 0).value();
        store_ = parts.store;
        session_ = std::make_unique<game::Session>(std::move(parts.parts));
        world_ = std::make_unique<ClientWorld>(
            *session_, *store_, [this](const ClientMessage& message) { toServer_.add(message, due()); });
        join();
        spawn_ = goal_ = pose_.position;
    }

    // Call before and after each tick of the server.
    void update(int step) {
        step_ = step;
        if (wire_) {
            for (ServerMessage& message : wire_->take()) {
                if (const auto* ping = std::get_if<Ping>(&message)) wire_->say(Pong{ping->time});
                toClient_.add(std::move(message), due());
            }
            toClient_.deliver(step, [&](const ServerMessage& message) {
                ASSERT_FALSE(std::holds_alternative<Refused>(message)) << std::get<Refused>(message).reason;
                world_->onMessage(message);
            });
        }
        if (const auto corrected = world_->popCorrection()) pose_ = *corrected;
        session_->pipeline().setView(world::chunkOf(pose_.position), view_);
        session_->pipeline().update(server_.now);
        if (!wire_) return;
        world_->update(pose_, view_, 0, server_.now);
        toServer_.deliver(step, [&](const ClientMessage& message) { wire_->say(message); });
    }
    void work(int jobs) { runJobs(session_->jobs(), jobs); }
    void act() {
        walk();
        if (!wire_) return maybeReturn();
        const unsigned what = random_() % 100;
        if (what < 30) return edit();
        if (what < 33) return fill();
        if (what < 38) return takeBack(what % 2 ? game::HistoryWay::Undo : game::HistoryWay::Redo);
        if (what == 38 && random_() % 3 == 0) cut();
    }
    void hurry() {
        isHurried_ = true;
        if (!wire_) join();
    }
    bool isSettled() const {
        const auto progress = session_->pipeline().progress();
        return toServer_.isEmpty() && toClient_.isEmpty() && world_->undecidedCount() == 0 &&
               world_->isViewComplete() && progress.isUpToDate();
    }
    // Differences between the player's world and the server's; empty if there are none.
    std::string difference() {
        const world::ChunkPos own = world::chunkOf(pose_.position);
        for (const world::ChunkPos pos : world::chunksWithin(own, view_ + 1)) {
            const world::ChunkPtr mine = session_->world().maybeChunkAt(pos);
            const world::ChunkPtr right = server_.state().session.pipeline().chunkAt(pos);
            if (!mine) return fmt::format("{}: no chunk {} {}", identity_.name, pos.x, pos.y);
            ChunkDifference blocks = chunkDifference(*right, *mine);
            std::erase_if(blocks, [&](const ChangedBlock& block) { return isToBeLookedAt(*right, block); });
            if (blocks.empty()) continue;
            const auto& [index, value] = blocks.front();
            return fmt::format("{}: {} blocks of chunk {} {}, as {} at {}: {}.{}, not {}.{}", identity_.name,
                               blocks.size(), pos.x, pos.y, index, index >> 8, nameOfBlock(value.id),
                               value.state, nameOfBlock(right->block(index)), right->blockState(index));
        }
        return {};
    }
    std::size_t acts() const { return acts_; }

  private:
    // Liquid beside a refused edit stays marked for a flow that players' worlds do not have. This is
    // invisible.
    static bool isToBeLookedAt(const world::Chunk& right, const ChangedBlock& block) {
        const bool isLiquid = world::isFlowing(contentBlocks().type(block.value.id));
        const bool isSame = isLiquid && block.value.id == right.block(block.index) && !block.value.data;
        return isSame && (block.value.state ^ right.blockState(block.index)) == world::kUnsettled;
    }
    static std::string nameOfBlock(world::BlockId id) { return contentBlocks().type(id).name; }
    int due() { return step_ + (isHurried_ ? 0 : static_cast<int>(random_() % kMaxDelay)); }

    void join() {
        wire_ = std::make_unique<TestWire>(server_);
        const ServerMessage answer = logIn(*wire_, identity_);
        ASSERT_TRUE(std::holds_alternative<Joined>(answer));
        pose_ = poseOf(std::get<Joined>(answer).pose);
        world_->onMessage(answer);
    }
    // Half of the disconnects are without Leave.
    void cut() {
        if (random_() % 2) wire_->say(Leave{});
        wire_->close();
        wire_.reset();
        toServer_.clear();
        toClient_.clear();
        world_->onCut();
    }
    void maybeReturn() {
        if (random_() % 40 == 0) join();
    }
    void walk() {
        const glm::dvec3 way = goal_ - pose_.position;
        const double length = glm::length(way);
        if (length > kStepBlocks) {
            pose_.position += way * (kStepBlocks / length);
        } else if (random_() % 30 == 0) {
            const auto away = [&] { return (static_cast<double>(random_() % 2001) / 1000 - 1) * kAway; };
            goal_ = {spawn_.x + away(), spawn_.y + away(), spawn_.z};
        }
    }
    world::BlockPos nearby(int reach) {
        const auto offset = [&] {
            return static_cast<std::int32_t>(random_() % static_cast<unsigned>(2 * reach + 1)) - reach;
        };
        const glm::dvec3 at = glm::floor(pose_.position);
        return {static_cast<std::int32_t>(at.x) + offset(), static_cast<std::int32_t>(at.y) + offset(),
                std::clamp(static_cast<std::int32_t>(at.z) + offset(), 1, 255)};
    }
    world::BlockId anyBlock() {
        static const std::vector<std::string> often{"sand", "water", "glass", "dirt", "air"};
        const std::size_t k = random_() % (2 * often.size());
        if (k < often.size()) return contentBlock(often[k]);
        return static_cast<world::BlockId>(random_() % contentBlocks().types().size());
    }
    void edit() {
        const world::BlockPos pos = nearby(4);
        if (!session_->world().maybeChunkAt(world::chunkOf(pos))) return;
        const world::BlockId there = session_->world().block(pos);
        world::BlockChange change = world::SetBlock{anyBlock(), static_cast<std::uint16_t>(random_() % 4)};
        if (random_() % 8 == 0) change = world::UseBlock{};
        std::optional<world::BlockId> expected;
        if (random_() % 4) expected = there;
        acts_ += session_->edit({game::kLocalPlayer, pos, change, expected}) == game::EditResult::Applied;
    }
    void takeBack(game::HistoryWay way) {
        EXPECT_EQ(session_->undoOrRedo(game::kLocalPlayer, way).outcome, game::UndoResult::Outcome::Sent);
    }
    void fill() {
        const world::BlockPos low = nearby(8);
        const auto high = [&](std::int32_t from) { return from + static_cast<std::int32_t>(random_() % 5); };
        std::optional<world::BlockId> replaced;
        if (random_() % 3 == 0) replaced = world::kAir;
        const world::BlockBox box{low, {high(low.x), high(low.y), std::min(high(low.z), 255)}};
        const auto filled =
            session_->build({game::kLocalPlayer, game::FillBox{box, anyBlock(), 0, replaced}});
        acts_ += filled.result == game::BuildOutcome::Result::Sent;
    }

    std::mt19937 random_;
    TestServer& server_;
    ClientIdentity identity_;
    int view_, step_ = 0;
    bool isHurried_ = false;
    std::size_t acts_ = 0;
    SlowWay<ClientMessage> toServer_;
    SlowWay<ServerMessage> toClient_;
    std::unique_ptr<TestWire> wire_;
    RemoteStore* store_ = nullptr;
    std::unique_ptr<game::Session> session_;
    std::unique_ptr<ClientWorld> world_;
    world::Pose pose_;
    glm::dvec3 spawn_{0}, goal_{0};
};

class Convergence : public testing::TestWithParam<unsigned> {
  protected:
    base::TempFolder folder_;
};

TEST_P(Convergence, EverybodyHasTheServersWorld) {
    TestServer server(folder_.path());
    std::vector<std::unique_ptr<RandomPlayer>> players;
    for (int k = 0; k < kPlayers; ++k)
        players.push_back(std::make_unique<RandomPlayer>(server, k, GetParam()));
    int step = 0;
    const auto tickAll = [&](int jobs) {
        for (const auto& player : players) player->update(step);
        net::tick(server.state(), server.now += kServerTick);
        runJobs(server.state().session.jobs(), jobs);
        server.finishWrites();
        for (const auto& player : players) player->update(step);
        for (const auto& player : players) player->work(jobs);
        ++step;
    };
    while (step < kSteps && !HasFatalFailure()) {
        for (const auto& player : players) player->act();
        tickAll(step / 100 % 2 ? kManyJobs : kFewJobs);
    }
    for (const auto& player : players) player->hurry();
    const auto areSettled = [&] {
        return std::ranges::all_of(players, [](const auto& player) { return player->isSettled(); });
    };
    for (int k = 0; k < kMostTicks && (k == 0 || !areSettled()); ++k) tickAll(kManyJobs);
    ASSERT_TRUE(areSettled());
    std::size_t acts = 0;
    for (const auto& player : players) {
        EXPECT_EQ(player->difference(), "");
        acts += player->acts();
    }
    EXPECT_GT(acts, 200u) << "something was done";
}

INSTANTIATE_TEST_SUITE_P(Seeds, Convergence, testing::Values(1u, 2u));

}  // namespace
}  // namespace terrane::net
