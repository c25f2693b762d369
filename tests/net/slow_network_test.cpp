// Players over a network that is slow, stalls and breaks: each edit is applied once, and all worlds become
// equal.
#include <random>

#include "terrane/net/server/server.h"
#include "tests/net/socket_fixture.h"
#include "tests/net/test_proxy.h"

namespace terrane::net {
namespace {

class SlowNetwork : public SocketTest {
  protected:
    // One player near the server, one behind the proxy.
    void startBoth(std::chrono::milliseconds delay, bool splits) {
        start();
        proxy_ = std::make_unique<TestProxy>(context_, port_);
        proxy_->delay = delay;
        proxy_->splits = splits;
        near_ = &addPlayer("Near");
        far_ = &addPlayer("Far", proxy_->port());
        ASSERT_TRUE(runUntil([&] { return near_->isLoaded() && far_->isLoaded(); }));
    }
    // Builds a row of blocks with one edit each.
    void build(int count) {
        for (int k = 0; k < count; ++k) {
            const world::BlockPos pos = far_->above(k % 4);
            ASSERT_EQ(far_->put({pos.x, pos.y, pos.z + k / 4}, "glass"), game::EditResult::Applied);
            runOnce();
        }
    }
    int glassOf(LinkPlayer& player, int count) {
        int glass = 0;
        for (int k = 0; k < count; ++k) {
            const world::BlockPos pos = far_->above(k % 4);
            glass += player.session->world().block({pos.x, pos.y, pos.z + k / 4}) == contentBlock("glass");
        }
        return glass;
    }
    void expectAllArrive(int count) {
        EXPECT_TRUE(runUntil([&] { return far_->world->undecidedCount() == 0; }));
        EXPECT_TRUE(runUntil([&] { return glassOf(*near_, count) == count; }));
        EXPECT_EQ(glassOf(*far_, count), count);
        EXPECT_EQ(server_->server.state().history.newest, count) << "each once";
        EXPECT_EQ(far_->joins, 1);
    }

    std::unique_ptr<TestProxy> proxy_;
    LinkPlayer* near_ = nullptr;
    LinkPlayer* far_ = nullptr;
};

TEST_F(SlowNetwork, EditsArriveOnceThroughDelays) {
    startBoth(std::chrono::milliseconds(30), false);
    build(20);
    expectAllArrive(20);
}

TEST_F(SlowNetwork, EditsArriveOnceByteByByte) {
    startBoth(std::chrono::milliseconds(0), true);
    build(20);
    expectAllArrive(20);
}

TEST_F(SlowNetwork, EditsArriveOnceAfterAStall) {
    startBoth(std::chrono::milliseconds(10), false);
    build(8);
    proxy_->isStalled = true;
    for (int k = 8; k < 16; ++k) {
        const world::BlockPos pos = far_->above(k % 4);
        ASSERT_EQ(far_->put({pos.x, pos.y, pos.z + k / 4}, "glass"), game::EditResult::Applied);
    }
    for (int k = 0; k < 20; ++k) runOnce();
    proxy_->isStalled = false;
    expectAllArrive(16);
}

// Acknowledged edits exist; others may be lost, but then nobody sees them.
TEST_F(SlowNetwork, CutsAtAnyTime) {
    startBoth(std::chrono::milliseconds(20), false);
    std::mt19937 random(1);
    std::int64_t made = 0, acknowledged = 0;
    for (int cut = 0; cut < 4; ++cut) {
        for (int k = 0; k < 10; ++k) {
            const world::BlockPos pos = far_->above(static_cast<int>(random() % 4));
            const bool isAir = far_->session->world().block(pos) == world::kAir;
            made += far_->put(pos, isAir ? "glass" : "air") == game::EditResult::Applied;
            runOnce();
        }
        // The first cut comes after an edit has arrived, the others whenever the machine gets there.
        if (cut == 0) {
            ASSERT_TRUE(runUntil([&] { return server_->server.state().history.newest > 0; }));
        }
        acknowledged = made - static_cast<std::int64_t>(far_->world->undecidedCount());
        proxy_->cutAll();
        ASSERT_TRUE(runUntil([&] { return far_->joins == cut + 2 && far_->isLoaded(); }))
            << far_->link.reason();
        EXPECT_GE(server_->server.state().history.newest, acknowledged);
        made = server_->server.state().history.newest;  // the others are lost
    }
    EXPECT_GT(made, 0);
    const auto areEqual = [&] {
        for (int k = 0; k < 4; ++k) {
            const world::BlockPos pos = far_->above(k);
            const world::BlockId block = server_->server.state().session.world().block(pos);
            if (near_->session->world().block(pos) != block || far_->session->world().block(pos) != block)
                return false;
        }
        return far_->world->undecidedCount() == 0;
    };
    EXPECT_TRUE(runUntil(areEqual));
    EXPECT_EQ(server_->server.state().clients.playing.size(), 2u);
}

}  // namespace
}  // namespace terrane::net
