#include "terrane/game/sounds.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "tests/world/content_blocks.h"
#include "tests/world/put_block.h"

namespace terrane::game {
namespace {

constexpr double kFrame = 1.0 / 60;

// A floor of stone (z < 10) over 5×5 chunks.
class FootstepsTest : public testing::Test {
  protected:
    FootstepsTest() {
        for (int n = 0; n < 25; ++n) {
            auto chunk = std::make_shared<world::Chunk>();
            for (int i = 0; i < 10 * 256; ++i)
                chunk->setBlock(static_cast<world::BlockIndex>(i), contentBlock("stone"));
            world_.insert({n % 5 - 2, n / 5 - 2}, chunk);
        }
        (void)steps_.advance(c_);
    }
    void fill(world::BlockPos from, world::BlockPos to, std::string_view name) {
        for (int z = from.z; z <= to.z; ++z)
            for (int y = from.y; y <= to.y; ++y)
                for (int x = from.x; x <= to.x; ++x) world::putBlock(world_, {x, y, z}, contentBlock(name));
    }
    // As in a game: two steps of the character a frame.
    std::vector<FootEvent> run(double seconds, const world::CharacterInput& input) {
        std::vector<FootEvent> events;
        for (double t = 0; t < seconds; t += kFrame) {
            for (int k = 0; k < 2; ++k) c_ = world::advanceCharacter(world_, contentBlocks(), c_, input);
            if (const auto event = steps_.advance(c_)) events.push_back(*event);
        }
        return events;
    }
    world::BlockId ground(glm::dvec3 feet) const { return groundUnder(world_, contentBlocks(), feet); }

    world::World world_;
    world::Character c_{.feet = {0.5, 0.5, 10}, .isOnGround = true};
    Footsteps steps_;
};

TEST_F(FootstepsTest, WalkingMakesTwoStepsASecond) {
    (void)run(1, {.direction = {1, 0}});
    const auto events = run(4, {.direction = {1, 0}});
    EXPECT_GE(events.size(), 8u);
    EXPECT_LE(events.size(), 10u);
    for (const FootEvent& event : events) EXPECT_EQ(event, (FootEvent{FootEvent::Kind::Step, 0.7f}));
}

TEST_F(FootstepsTest, RunningMakesMoreAndLouderOnes) {
    (void)run(1, {.direction = {1, 0}, .runs = true});
    const auto events = run(3, {.direction = {1, 0}, .runs = true});
    EXPECT_GE(events.size(), 8u);
    EXPECT_LE(events.size(), 10u);
    for (const FootEvent& event : events) EXPECT_EQ(event.strength, 1);
}

TEST_F(FootstepsTest, WhoStandsIsSilent) {
    EXPECT_TRUE(run(3, {}).empty());
}

TEST_F(FootstepsTest, AFallEndsWithALanding) {
    c_ = {.feet = {0.5, 0.5, 20}};
    steps_.reset();
    const auto far = run(3, {});
    ASSERT_EQ(far.size(), 1u);
    EXPECT_EQ(far[0].kind, FootEvent::Kind::Land);
    c_ = {.feet = {0.5, 0.5, 11}};
    steps_.reset();
    const auto near = run(3, {});
    ASSERT_EQ(near.size(), 1u);
    EXPECT_LT(near[0].strength, far[0].strength);
}

TEST_F(FootstepsTest, AJumpMakesOneSound) {
    EXPECT_TRUE(run(0.2, {.jumps = true}).empty());
    const auto events = run(1.5, {});
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].kind, FootEvent::Kind::Land);
}

TEST_F(FootstepsTest, WaterSplashesAndIsSwumIn) {
    fill({-10, -10, 2}, {10, 10, 9}, "water");
    c_ = {.feet = {0.5, 0.5, 15}};
    steps_.reset();
    const auto fall = run(1.5, {});
    ASSERT_FALSE(fall.empty());
    EXPECT_EQ(fall[0].kind, FootEvent::Kind::Splash);
    const auto swim = run(3, {.direction = {1, 0}});
    ASSERT_FALSE(swim.empty());
    for (const FootEvent& event : swim) EXPECT_EQ(event.kind, FootEvent::Kind::Swim);
}

TEST_F(FootstepsTest, LaddersAreHeard) {
    fill({1, 0, 10}, {1, 0, 20}, "stone");
    fill({0, 0, 10}, {0, 0, 20}, "ladder");
    const auto events = run(2, {.jumps = true});
    ASSERT_GE(events.size(), 3u);
    EXPECT_EQ(events.back().kind, FootEvent::Kind::Climb);
}

TEST_F(FootstepsTest, WhoIsMovedMakesNoSound) {
    c_.feet.x += 30;
    EXPECT_FALSE(steps_.advance(c_));
    (void)run(0.2, {.direction = {1, 0}});
    steps_.reset();
    c_.feet.x += 3;
    EXPECT_FALSE(steps_.advance(c_)) << "after a reset the next place is the first one";
}

TEST_F(FootstepsTest, GroundIsWhatCarries) {
    world::putBlock(world_, {3, 0, 10}, contentBlock("white_carpet"));
    world::putBlock(world_, {5, 0, 10}, contentBlock("poppy"));
    EXPECT_EQ(ground({0.5, 0.5, 10}), contentBlock("stone"));
    EXPECT_EQ(ground({3.5, 0.5, 10.0625}), contentBlock("white_carpet"));
    EXPECT_EQ(ground({5.5, 0.5, 10}), contentBlock("stone")) << "flowers carry nobody";
    EXPECT_EQ(ground({0.5, 0.5, 14}), world::kAir);
}

TEST_F(FootstepsTest, GroundIsThereOverAnEdge) {
    world::putBlock(world_, {0, 0, 12}, contentBlock("oak_planks"));
    EXPECT_EQ(ground({1.2, 0.5, 13}), contentBlock("oak_planks"));
    EXPECT_EQ(ground({1.4, 0.5, 13}), world::kAir);
}

}  // namespace
}  // namespace terrane::game
