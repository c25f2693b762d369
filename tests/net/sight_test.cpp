#include "terrane/net/server/sight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace terrane::net {
namespace {

PlayerAt playerAt(game::PlayerId id, double x, double y, double z = 70) {
    return {id, wirePose({{x, y, z}, 0, 0}), 0};
}

TEST(PlayerGrid, FindsTheNearestOthers) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-900, 900);
    std::vector<PlayerAt> players;
    for (game::PlayerId id = 1; id <= 700; ++id)
        players.push_back(playerAt(id, place(random), place(random)));
    const PlayerGrid grid(players);
    for (const PlayerAt& center : players) {
        std::vector<std::pair<double, game::PlayerId>> expected;
        for (const PlayerAt& other : players) {
            const double distance = std::hypot(static_cast<double>(other.pose.x - center.pose.x),
                                               static_cast<double>(other.pose.y - center.pose.y)) /
                                    kPoseSteps;
            if (other.id != center.id && distance <= kLostBlocks) expected.push_back({distance, other.id});
        }
        std::ranges::sort(expected);
        expected.resize(std::min(expected.size(), kMaxSeen));
        const auto found = grid.around(center);
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(found[k].player->id, expected[k].second);
    }
}

// A client that accumulates pose changes has all positions, at most as old as the distance allows.
TEST(Sight, ToldPosesAddUpAndAreYoungEnough) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> place(-300, 300), step(-3, 3);
    std::vector<PlayerAt> players;
    for (game::PlayerId id = 1; id <= 60; ++id) players.push_back(playerAt(id, place(random), place(random)));
    struct Shown {
        game::PlayerId id;
        WirePose pose;
    };
    std::map<std::uint16_t, Shown> shown;
    std::map<game::PlayerId, std::vector<WirePose>> past;  // by tick
    Sight sight;
    for (std::uint64_t tick = 2; tick < 400; tick += kTicksPerSight) {
        for (PlayerAt& player : players) {
            if (player.id % 3 == 0) continue;  // stands still
            player.pose.x += std::llround(step(random) * kPoseSteps);
            player.pose.y += std::llround(step(random) * kPoseSteps);
        }
        for (const PlayerAt& player : players) past[player.id].push_back(player.pose);
        const PlayerGrid grid(players);
        const auto around = grid.around(players[0]);
        const SightChanges changes = sight.update(tick, around);
        for (const std::uint16_t slot : changes.disappeared) EXPECT_EQ(shown.erase(slot), 1u);
        for (const auto& [slot, player] : changes.appeared)
            EXPECT_TRUE(shown.insert({slot, {player->id, player->pose}}).second) << "the slot is free";
        for (const PoseChange& change : changes.poses) {
            ASSERT_TRUE(shown.contains(change.slot));
            EXPECT_NE(shown[change.slot].id % 3, 0u) << "who stands still is not told of";
            WirePose& pose = shown[change.slot].pose;
            pose.x += change.dx;
            pose.y += change.dy;
            pose.z += change.dz;
        }
        EXPECT_EQ(shown.size(), sight.seenCount());
        for (const auto& [slot, player] : shown) {
            const auto near =
                std::ranges::find(around, player.id, [](const auto& n) { return n.player->id; });
            ASSERT_NE(near, around.end());
            const auto& poses = past[player.id];
            const std::uint64_t updates = ticksBetweenPoses(near->distance) / kTicksPerSight;
            bool isYoung = false;
            for (std::size_t k = 0; k <= updates && k < poses.size(); ++k) {
                const WirePose& was = poses[poses.size() - 1 - k];
                isYoung = isYoung || (was.x == player.pose.x && was.y == player.pose.y);
            }
            EXPECT_TRUE(isYoung) << "player " << player.id << " at " << near->distance;
        }
    }
}

// Two players who move to the other end of the world together still see each other.
TEST(Sight, StepsMayBeAsLongAsTheWorld) {
    Sight sight;
    std::vector<PlayerAt> players{playerAt(1, -2147483000, 0), playerAt(2, -2147483005, 0)};
    const auto update = [&](std::uint64_t tick) {
        return sight.update(tick, PlayerGrid(players).around(players[0]));
    };
    ASSERT_EQ(update(2).appeared.size(), 1u);
    const std::int64_t from = players[1].pose.x;
    players = {playerAt(1, 2147483000, 0), playerAt(2, 2147483005, 0)};
    const SightChanges changes = update(4);
    ASSERT_EQ(changes.poses.size(), 1u);
    EXPECT_EQ(from + changes.poses[0].dx, players[1].pose.x);
}

// Pitch is transmitted in 256 steps.
TEST(Sight, LooksUpAndDownStayUpAndDown) {
    Sight sight;
    std::vector<PlayerAt> players{playerAt(1, 0, 0), playerAt(2, 5, 0)};
    std::uint64_t tick = 2;
    const auto update = [&] { return sight.update(tick += 2, PlayerGrid(players).around(players[0])); };
    (void)update();
    for (const float pitch : {-90.0f, -89.9f, -45.0f, -1.0f, 0.0f, 1.0f, 45.0f, 89.9f, 90.0f}) {
        players[1].pose = wirePose({{5, 0, 70}, 0, pitch});
        const SightChanges changes = update();
        ASSERT_EQ(changes.poses.size(), 1u) << pitch;
        const WirePose told{.pitch = static_cast<std::int16_t>(changes.poses[0].pitch * kPitchStep)};
        EXPECT_NEAR(poseOf(told).pitch, pitch, 0.8f);
    }
}

TEST(Sight, NobodyAtTheEdgeComesAndGoes) {
    Sight sight;
    std::vector<PlayerAt> players{playerAt(1, 0, 0), playerAt(2, kSightBlocks + 5, 0)};
    const auto update = [&](std::uint64_t tick) {
        return sight.update(tick, PlayerGrid(players).around(players[0]));
    };
    EXPECT_TRUE(update(2).appeared.empty());
    players[1] = playerAt(2, kSightBlocks - 5, 0);
    EXPECT_EQ(update(4).appeared.size(), 1u);
    players[1] = playerAt(2, kSightBlocks + 5, 0);
    EXPECT_TRUE(update(6).disappeared.empty());
    players[1] = playerAt(2, kLostBlocks + 5, 0);
    EXPECT_EQ(update(8).disappeared.size(), 1u);
    EXPECT_EQ(sight.seenCount(), 0u);
}

TEST(Sight, TellsOfAnArmThatSwings) {
    Sight sight;
    std::vector<PlayerAt> players{playerAt(1, 0, 0), playerAt(2, 5, 0)};
    const auto update = [&](std::uint64_t tick) {
        return sight.update(tick, PlayerGrid(players).around(players[0]));
    };
    update(2);
    EXPECT_TRUE(update(4).poses.empty());
    players[1].swungTick = 5;
    const SightChanges changes = update(6);
    ASSERT_EQ(changes.poses.size(), 1u);
    EXPECT_TRUE(changes.poses[0].swings);
    EXPECT_TRUE(update(8).poses.empty()) << "once";
}

}  // namespace
}  // namespace terrane::net
