#include "terrane/net/client/client_world.h"

#include "tests/net/server_fixture.h"

namespace terrane::net {
namespace {

TEST(ClientWorld, AStoppedClockKeepsTheLengthOfItsDay) {
    const base::TempFolder folder;
    TestServer server(folder.path());
    TestPlayer anna(server, testIdentity("Anna"), 1);
    const game::DayClock& clock = anna.session->clock;
    anna.world->onMessage(Clock{.timeDay = 0.25, .daysASecond = 1.0 / 600});
    EXPECT_TRUE(clock.isRunning);
    EXPECT_DOUBLE_EQ(clock.dayMinutes, 10);
    anna.world->onMessage(Clock{.timeDay = 0.5, .daysASecond = 0});
    EXPECT_FALSE(clock.isRunning);
    EXPECT_DOUBLE_EQ(clock.timeDay, 0.5);
    EXPECT_DOUBLE_EQ(clock.dayMinutes, 10);
}

// The server was killed and has lost changes that this client saw, such as those of flowing water.
TEST(ClientWorld, WhatTheServerLostDisappearsAfterReconnecting) {
    const base::TempFolder folder;
    TestServer server(folder.path());
    TestPlayer anna(server, testIdentity("Anna"), 2, 128);
    ASSERT_TRUE(stepUntil(server, {&anna}, [&] { return anna.isLoaded(); }));
    const world::ChunkPos own = world::chunkOf(anna.pose.position), tile{(own.x >> 1) + 4, own.y >> 1, 1};
    const world::BlockIndex at = world::blockIndex(1, 2, 250), other = world::blockIndex(3, 2, 250);
    const ChunkDifference lost{{at, {contentBlock("stone"), 0, {}}}};
    const auto seeAndReconnect = [&] {
        anna.world->onMessage(ChunkEdits{tile, true, lost});
        anna.world->onMessage(BlocksChanged{own, lost});
        EXPECT_EQ(anna.block(world::blockPos(own, at)), contentBlock("stone"));
        anna.wire->close();
        anna.wire = std::make_unique<TestWire>(server);
        anna.join();
        EXPECT_EQ(anna.block(world::blockPos(own, at)), contentBlock("stone"));
    };

    seeAndReconnect();
    ASSERT_TRUE(stepUntil(server, {&anna}, [&] { return anna.isLoaded(); }));
    EXPECT_EQ(anna.block(world::blockPos(own, at)), world::kAir);
    EXPECT_TRUE(anna.store->positions().empty());

    seeAndReconnect();
    anna.world->onMessage(BlocksChanged{own, {{other, {contentBlock("glass"), 0, {}}}}});
    EXPECT_EQ(anna.block(world::blockPos(own, at)), world::kAir) << "its first change since it was generated";
    EXPECT_EQ(anna.block(world::blockPos(own, other)), contentBlock("glass"));
}

}  // namespace
}  // namespace terrane::net
