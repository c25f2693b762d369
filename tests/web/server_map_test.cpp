// The players that a server's map shows.
#include "terrane/web/server_map.h"

#include <gtest/gtest.h>

#include "tests/net/server_fixture.h"
#include "tests/support/default_heights.h"

namespace terrane::web {
namespace {

class ServerPlayersTest : public ::testing::Test {
  protected:
    ServerPlayersTest() { (void)net::logIn(ann_, net::testIdentity("Ann")); }

    // Moves Ann to a height in blocks above or below the ground's highest opaque block.
    void stand(int above) {
        net::ServerClient& client = server_.state().clients.all.begin()->second;
        world::Pose pose = net::poseOf(client.pose);
        const auto chunk = world::chunkOf(pose.position);
        ASSERT_TRUE(waitFor([&] { return server_.state().session.world().maybeChunkAt(chunk) != nullptr; }));
        const auto x = static_cast<std::int32_t>(std::floor(pose.position.x)),
                   y = static_cast<std::int32_t>(std::floor(pose.position.y));
        std::int32_t ground = world::kChunkHeight - 1;
        const game::Session& session = server_.state().session;
        while (!session.blocks().type(session.world().block({x, y, ground})).opaqueCube) --ground;
        pose.position.z = ground + above + 0.5;
        client.pose = net::wirePose(pose);
    }
    void move(double blocks) {
        net::ServerClient& client = server_.state().clients.all.begin()->second;
        world::Pose pose = net::poseOf(client.pose);
        pose.position.x += blocks;
        client.pose = net::wirePose(pose);
    }
    template <class Condition>
    bool waitFor(Condition condition) {
        for (int k = 0; k < net::kMostTicks; ++k) {
            (void)list_.now();
            if (condition()) return true;
            server_.tick();
        }
        return false;
    }
    std::size_t shown(ShownPlayers which) {
        ServerPlayers list(server_.state().clients, server_.state().session, which);
        return list.now().size();
    }

    base::TempFolder folder_;
    net::TestServer server_{folder_.path(), net::patientSettings()};
    net::TestWire ann_{server_};
    ServerPlayers list_{server_.state().clients, server_.state().session, ShownPlayers::Surface};
};

TEST_F(ServerPlayersTest, NobodyIsHiddenOnTheSurface) {
    stand(2);
    ASSERT_EQ(list_.now().size(), 1u);
    EXPECT_EQ(list_.now()[0].name, "Ann");
    EXPECT_EQ(shown(ShownPlayers::None), 0u);
}

TEST_F(ServerPlayersTest, ThreeBlocksHide) {
    stand(-2);
    EXPECT_EQ(list_.now().size(), 1u) << "a cellar with two blocks above it";
    stand(-3);
    EXPECT_TRUE(list_.now().empty());
    EXPECT_EQ(shown(ShownPlayers::All), 1u);
    stand(2);
    EXPECT_EQ(list_.now().size(), 1u);
}

TEST_F(ServerPlayersTest, WhoCrossesIntoAChunkThatIsNotLoadedStaysAsItWas) {
    EXPECT_TRUE(list_.now().empty()) << "a newcomer of whom nothing is known";
    stand(2);
    ASSERT_EQ(list_.now().size(), 1u);
    move(16);
    EXPECT_EQ(list_.now().size(), 1u);
    move(32);
    EXPECT_TRUE(list_.now().empty()) << "farther away it may be in a cave";
}

}  // namespace
}  // namespace terrane::web
