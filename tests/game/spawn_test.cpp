#include "terrane/game/spawn.h"

#include "terrane/gen/language/builder.h"
#include "terrane/world/character.h"
#include "tests/game/session_fixture.h"

namespace terrane::game {
namespace {

class BackOnSurface : public SessionTest {
  protected:
    std::optional<world::Pose> from(glm::dvec3 position) const {
        return poseOnSurface(session_.world(), session_.blocks(), {.position = position, .yaw = 30});
    }
};

// Land with this ground; if it is wet, all but one chunk lies under water.
world::Pose spawnOn(const std::function<gen::Block(gen::Pass&)>& cover, bool isWet = false) {
    gen::GeneratorBuilder builder("test", contentBlocks());
    const auto isThere = [](gen::Pass& p) { return p.x() >= 96 && p.x() < 112 && p.y() >= 0 && p.y() < 16; };
    builder.pass3D("ground", [&](gen::Pass& p) {
        const gen::Int z = p.z();
        const gen::Block air =
            isWet ? select(z <= 70 && !isThere(p), p.block("water"), p.block("air")) : p.block("air");
        p.setBlock(select(z <= 64, cover(p), air));
    });
    return findSpawn(gen::Generator(std::move(builder.finish().value()), 1), contentBlocks());
}

TEST(Spawn, IsOnGrassWhereThereIsSome) {
    const auto pose =
        spawnOn([](gen::Pass& p) { return select(p.x() >= 96, p.block("grass"), p.block("sand")); });
    EXPECT_EQ(pose.position, glm::dvec3(104.5, -87.5, 65 + world::kEyeHeight));
}

TEST(Spawn, IsOnOtherDryGroundWhereNoGrassIs) {
    const auto sand = [](gen::Pass& p) { return p.block("sand"); };
    EXPECT_EQ(spawnOn(sand).position, glm::dvec3(8.5, 8.5, 65 + world::kEyeHeight));
    const auto island = spawnOn(sand, true);
    EXPECT_EQ(island.position, glm::dvec3(104.5, 8.5, 65 + world::kEyeHeight)) << "not in the water";
}

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
