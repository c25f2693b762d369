// Where players appear who join a server.
#include <glm/vector_relational.hpp>

#include "terrane/net/server/server.h"
#include "terrane/world/character.h"
#include "tests/net/server_fixture.h"

namespace terrane::net {
namespace {

class SpawnTest : public testing::TestWithParam<int> {  // spawn radius
  protected:
    static glm::dvec3 feetOf(const world::Pose& pose) {
        return pose.position - glm::dvec3(0, 0, world::kEyeHeight);
    }
    // The pose that the server gives to a new player.
    world::Pose join(const std::string& name) {
        wires_.push_back(std::make_unique<TestWire>(server_));
        const ServerMessage answer = logIn(*wires_.back(), testIdentity(name));
        const auto* joined = std::get_if<Joined>(&answer);
        EXPECT_TRUE(joined) << name;
        return joined ? poseOf(joined->pose) : world::Pose();
    }
    const world::BlockType& blockAt(const glm::dvec3& point) const {
        const world::BlockPos pos = world::blockOf(point);
        const world::Chunk chunk = server_.host.session->generator().generate(world::chunkOf(pos));
        return contentBlocks().type(chunk.block(world::blockIndex(pos)));
    }
    void expectStands(const world::Pose& pose) const {
        const glm::dvec3 feet = feetOf(pose) + glm::dvec3(0, 0, 0.05);  // poses are rounded
        EXPECT_TRUE(blockAt(feet - glm::dvec3(0, 0, 0.5)).opaqueCube);
        for (const double height : {0.0, 1.0}) {
            const world::BlockType& type = blockAt(feet + glm::dvec3(0, 0, height));
            EXPECT_TRUE(type.collision.empty() && type.shape != world::Shape::Liquid) << type.name;
        }
    }
    // No two share a part of space.
    static void expectApart(const std::vector<world::Pose>& poses) {
        for (std::size_t a = 0; a < poses.size(); ++a) {
            for (std::size_t b = a + 1; b < poses.size(); ++b) {
                const world::Aabb one = world::characterBox(feetOf(poses[a])),
                                  other = world::characterBox(feetOf(poses[b]));
                EXPECT_FALSE(glm::all(glm::lessThan(one.min, other.max)) &&
                             glm::all(glm::lessThan(other.min, one.max)))
                    << a << " and " << b;
            }
        }
    }
    static ServerSettings settingsOf(int radius) {
        ServerSettings settings = patientSettings();
        settings.maxPlayersOfAddress = 100;
        settings.spawnRadius = radius;
        return settings;
    }

    base::TempFolder folder_;
    TestServer server_{folder_.path(), settingsOf(GetParam())};
    std::vector<std::unique_ptr<TestWire>> wires_;
};

TEST_P(SpawnTest, ThirtyWhoJoinAtOnceStandApart) {
    std::vector<world::Pose> poses;
    for (int k = 0; k < 30; ++k) {
        poses.push_back(join("Player" + std::to_string(k)));
        expectStands(poses.back());
    }
    expectApart(poses);
}

INSTANTIATE_TEST_SUITE_P(Radius, SpawnTest, testing::Values(0, 40));

}  // namespace
}  // namespace terrane::net
