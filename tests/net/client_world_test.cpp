#include "terrane/net/client_world.h"

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

}  // namespace
}  // namespace terrane::net
