#include "terrane/game/player.h"

#include "tests/game/session_fixture.h"
#include "tests/world/put_block.h"

namespace terrane::game {
namespace {

class PlayerTest : public SessionTest {
  protected:
    // Walks along +x for a second, against a wall of this height.
    double zAfterWalking(int wall, bool autoJump) {
        for (int z = 0; z < wall; ++z)
            for (int y = 2; y < 9; ++y)
                session_.edit(
                    {kNoPlayer, {8, y, kGroundHeight + z}, world::SetBlock{contentBlock("stone")}, {}});
        Player player({.position = {5.5, 5.5, kGroundHeight + world::kEyeHeight}}, Movement::Walk);
        const MoveKeys keys{.forward = true, .autoJump = autoJump};
        for (int frame = 0; frame < 60; ++frame)
            player.move(session_.world(), session_.blocks(), keys, 1.0 / 60);
        return player.pose().position.z - world::kEyeHeight - kGroundHeight;
    }
};

TEST_F(PlayerTest, JumpsOntoABlockByItself) {
    EXPECT_GE(zAfterWalking(1, true), 1 - 1e-3);
}

TEST_F(PlayerTest, StaysWhereItIsWithoutThat) {
    EXPECT_NEAR(zAfterWalking(1, false), 0, 1e-3);
}

TEST_F(PlayerTest, DoesNotHopAgainstAHigherWall) {
    EXPECT_NEAR(zAfterWalking(2, true), 0, 1e-3);
}

// Flies along +x for a second; returns the way.
double wayInASecond(const Session& session, Movement movement, bool runs, glm::dvec3 start) {
    Player player({.position = start}, movement);
    const MoveKeys keys{.forward = true, .run = runs};
    for (int frame = 0; frame < 60; ++frame) player.move(session.world(), session.blocks(), keys, 1.0 / 60);
    return player.pose().position.x - start.x;
}

TEST_F(PlayerTest, FlightHasTwoSpeeds) {
    const glm::dvec3 start(0.5, 5.5, kGroundHeight + 20);
    // A tenth of a second is lost until the speed is reached.
    EXPECT_NEAR(wayInASecond(session_, Movement::Fly, false, start), world::kFlySpeed, 1.2);
    EXPECT_NEAR(wayInASecond(session_, Movement::Fly, true, start), world::kFlyRunSpeed, 2.4);
    EXPECT_NEAR(wayInASecond(session_, Movement::Noclip, false, start), double{kNoclipSpeed}, 0.1);
    EXPECT_NEAR(wayInASecond(session_, Movement::Noclip, true, start), double{kNoclipRunSpeed}, 0.1);
}

TEST_F(PlayerTest, OnlyNoclipPassesThroughBlocks) {
    for (int z = 20; z < 24; ++z)
        for (int y = 3; y < 9; ++y)
            session_.edit({kNoPlayer, {8, y, kGroundHeight + z}, world::SetBlock{contentBlock("stone")}, {}});
    const glm::dvec3 start(0.5, 5.5, kGroundHeight + 22);
    const double free = 7.5 - world::kCharacterWidth / 2;
    for (const bool runs : {false, true})
        EXPECT_NEAR(wayInASecond(session_, Movement::Fly, runs, start), free, 1e-2);
    EXPECT_GT(wayInASecond(session_, Movement::Noclip, false, start), free + 5);
}

TEST_F(PlayerTest, FlightStopsAboveTheGround) {
    Player player({.position = {5.5, 5.5, kGroundHeight + 8}}, Movement::Fly);
    for (int frame = 0; frame < 120; ++frame)
        player.move(session_.world(), session_.blocks(), {.down = true, .run = true}, 1.0 / 60);
    EXPECT_NEAR(player.pose().position.z, kGroundHeight + world::kEyeHeight, 1e-2);
    for (int frame = 0; frame < 60; ++frame)
        player.move(session_.world(), session_.blocks(), {.jump = true}, 1.0 / 60);
    EXPECT_NEAR(player.pose().position.z, kGroundHeight + world::kEyeHeight + world::kFlySpeed, 1.2);
}

}  // namespace
}  // namespace terrane::game
