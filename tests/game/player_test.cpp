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
        Player player({.position = {5.5, 5.5, kGroundHeight + world::kEyeHeight}}, Movement::Gravity);
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

}  // namespace
}  // namespace terrane::game
