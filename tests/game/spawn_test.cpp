#include "terrane/game/spawn.h"

#include "terrane/world/character.h"
#include "tests/game/session_fixture.h"

namespace terrane::game {
namespace {

class BackOnSurface : public SessionTest {
  protected:
    std::optional<world::Pose> from(glm::dvec3 position) const {
        return backOnSurface(session_.world(), session_.blocks(), {.position = position, .yaw = 30});
    }
};

TEST_F(BackOnSurface, WhoIsBelowTheWorldStandsOnTheGround) {
    const auto pose = from({5.5, 6.5, -4055});
    ASSERT_TRUE(pose);
    EXPECT_EQ(pose->position, glm::dvec3(5.5, 6.5, kGroundHeight + world::kEyeHeight));
    EXPECT_EQ(pose->yaw, 30);
}

TEST_F(BackOnSurface, OthersStay) {
    EXPECT_FALSE(from({5.5, 6.5, 0}));
    EXPECT_FALSE(from({5.5, 6.5, 80}));
    EXPECT_FALSE(from({5000, 6.5, -10})) << "no chunk is loaded there";
}

TEST_F(BackOnSurface, NobodyStandsOnAnEmptyColumn) {
    std::vector<EditCommand> commands;
    for (int z = 0; z < kGroundHeight; ++z) commands.push_back({kNoPlayer, {5, 6, z}, world::SetBlock{}, {}});
    session_.edit(commands);
    EXPECT_FALSE(from({5.5, 6.5, -10}));
}

}  // namespace
}  // namespace terrane::game
