#include "terrane/game/permissions.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/game/session_fixture.h"

namespace terrane::game {
namespace {

constexpr PlayerId kOwner = 7, kNeighbor = 8, kOperator = 9, kGuest = 10;
const world::BlockPos kInClaim{5, 5, kGroundHeight}, kOutside{7, 5, kGroundHeight};

class PermissionsTest : public SessionTest {
  protected:
    PermissionsTest() {
        for (const PlayerId player : {kOwner, kNeighbor, kOperator, kGuest})
            session_.setPlayer(player, {.position = {6, 5.5, kGroundHeight + 2.0}});
        session_.permissions.roles = {{kOperator, Role::Operator}, {kGuest, Role::Guest}};
        EXPECT_TRUE(session_.permissions.claims.add({"Anna's", {0, 0, 5, 9}, kOwner, {}}));
    }
    EditResult put(world::BlockPos pos, PlayerId player) {
        return session_.edit({player, pos, world::SetBlock{contentBlock("glass")}, std::nullopt});
    }
    BuildOutcome::Result fill(world::BlockPos low, world::BlockPos high, PlayerId player) {
        return session_.build({player, FillBox{{low, high}, contentBlock("glass"), 0, {}}}).result;
    }
    world::BlockId at(world::BlockPos pos) const { return session_.world().block(pos); }
};

TEST_F(PermissionsTest, AClaimIsChangedByItsOwnerItsMembersAndOperators) {
    EXPECT_EQ(put(kInClaim, kNeighbor), EditResult::Claimed);
    EXPECT_EQ(at(kInClaim), world::kAir);
    EXPECT_EQ(put(kOutside, kNeighbor), EditResult::Applied);
    EXPECT_EQ(put(kInClaim, kOwner), EditResult::Applied);
    EXPECT_EQ(put({4, 5, kGroundHeight}, kOperator), EditResult::Applied);
    session_.permissions.claims.remove("Anna's");
    ASSERT_TRUE(session_.permissions.claims.add({"Anna's", {0, 0, 5, 9}, kOwner, {kNeighbor}}));
    EXPECT_EQ(put({3, 5, kGroundHeight}, kNeighbor), EditResult::Applied);
}

TEST_F(PermissionsTest, GuestsChangeNothing) {
    EXPECT_EQ(put(kOutside, kGuest), EditResult::NotAllowed);
    EXPECT_EQ(session_.edit({kGuest, kOutside, world::UseBlock{}, {}}), EditResult::NotAllowed);
    EXPECT_EQ(fill(kOutside, kOutside, kGuest), BuildOutcome::Result::NotAllowed);
    EXPECT_EQ(at(kOutside), world::kAir);
}

TEST_F(PermissionsTest, ABoxThatReachesIntoAClaimIsNotFilled) {
    EXPECT_EQ(fill(kInClaim, kOutside, kNeighbor), BuildOutcome::Result::NotAllowed);
    EXPECT_EQ(at(kOutside), world::kAir) << "all or nothing";
    EXPECT_EQ(fill(kOutside, {9, 5, kGroundHeight}, kNeighbor), BuildOutcome::Result::Done);
    EXPECT_EQ(fill(kInClaim, kOutside, kOwner), BuildOutcome::Result::Done);
}

// The claim has columns 0 to 5.
TEST_F(PermissionsTest, AShapeChangesOnlyItsOwnBlocks) {
    const auto build = [&](ShapeKind kind, world::BlockPos low, world::BlockPos high) {
        return session_.build({kNeighbor, FillBox{{low, high}, contentBlock("glass"), 0, {}, {kind}}}).result;
    };
    const world::BlockPos low{-1, -1, kGroundHeight}, high{6, 10, kGroundHeight + 2};
    EXPECT_EQ(build(ShapeKind::Walls, low, high), BuildOutcome::Result::Done) << "around the claim";
    EXPECT_EQ(at(kInClaim), world::kAir);
    EXPECT_EQ(build(ShapeKind::Hollow, low, high), BuildOutcome::Result::NotAllowed) << "floor and ceiling";
    EXPECT_EQ(build(ShapeKind::Sphere, low, high), BuildOutcome::Result::NotAllowed);
    EXPECT_EQ(build(ShapeKind::Line, low, high), BuildOutcome::Result::NotAllowed);
    EXPECT_EQ(at(kInClaim), world::kAir);
}

TEST_F(PermissionsTest, NobodyUndoesWhatBecameAClaimOfOthers) {
    const world::BlockPos elsewhere{10, 5, kGroundHeight};
    ASSERT_EQ(put(elsewhere, kNeighbor), EditResult::Applied);
    ASSERT_EQ(put(kOutside, kNeighbor), EditResult::Applied);
    ASSERT_TRUE(session_.permissions.claims.add({"later", {6, 0, 9, 9}, kOwner, {}}));
    const auto undo = [&] { return session_.undoOrRedo(kNeighbor, HistoryWay::Undo).outcome; };
    EXPECT_EQ(undo(), UndoResult::Outcome::NotAllowed);
    EXPECT_EQ(at(kOutside), contentBlock("glass"));
    EXPECT_EQ(undo(), UndoResult::Outcome::Done) << "the edit before it";
    EXPECT_EQ(at(elsewhere), world::kAir);
    session_.permissions.claims.remove("later");
    EXPECT_EQ(undo(), UndoResult::Outcome::NoStep);
}

// Water beside a claim would wash away what its owner planted.
TEST_F(PermissionsTest, LiquidDoesNotFlowIntoAClaim) {
    const world::BlockPos flower{5, 5, kGroundHeight - 1};
    const auto set = [&](world::BlockPos pos, std::string_view name, PlayerId player) {
        return session_.edit({player, pos, world::SetBlock{contentBlock(name)}, {}});
    };
    ASSERT_EQ(set({5, 5, kGroundHeight - 2}, "dirt", kOwner), EditResult::Applied);
    ASSERT_EQ(set(flower, "poppy", kOwner), EditResult::Applied);
    ASSERT_EQ(set({6, 5, kGroundHeight - 1}, "water", kNeighbor), EditResult::Applied);
    ASSERT_EQ(set({6, 5, kGroundHeight}, "water", kNeighbor), EditResult::Applied);
    const auto flow = [&] {
        for (int k = 0; k < 40; ++k) session_.advance(0.25, {0, 0});
    };
    flow();
    EXPECT_EQ(at(flower), contentBlock("poppy"));
    EXPECT_EQ(at(kInClaim), world::kAir);
    EXPECT_EQ(at({9, 5, kGroundHeight}), contentBlock("water")) << "outside it flows";
    // The owner's own water flows, also out of the claim.
    ASSERT_EQ(set({2, 5, kGroundHeight}, "water", kOwner), EditResult::Applied);
    flow();
    EXPECT_EQ(at(kInClaim), contentBlock("water"));
    EXPECT_EQ(at(flower), contentBlock("water"));
}

// What stands on a block outside must not fall.
TEST_F(PermissionsTest, NoConsequenceOfAnEditBreaksABlockInAClaim) {
    const world::BlockId torch = contentBlock("torch");
    const world::BlockPos wall{6, 5, kGroundHeight};
    int refused = 0;
    for (std::uint16_t facing = 0; facing < 4; ++facing) {
        (void)put(wall, kNeighbor);
        const auto leaning = static_cast<std::uint16_t>(world::kStateOther | facing);
        session_.setBlocks(std::vector<world::PlacedBlock>{{kInClaim, {torch, leaning, nullptr}}});
        if (session_.edit({kNeighbor, wall, world::SetBlock{world::kAir}, {}}) == EditResult::Claimed) {
            ++refused;
            EXPECT_EQ(at(wall), contentBlock("glass")) << "refused as a whole";
        }
        EXPECT_EQ(at(kInClaim), torch);
    }
    EXPECT_GT(refused, 0);
}

// A flood is a change by the player who let the water flow, and can be found and taken back.
TEST_F(PermissionsTest, FlowIsAChangeByWhoCausedIt) {
    std::map<PlayerId, std::size_t> changed;
    const Subscription listening = session_.events.changed.add(
        [&](const BlocksChanged& event) { changed[event.author.player] += event.blocks.size(); });
    const auto set = [&](world::BlockPos pos, std::string_view name, PlayerId player) {
        return session_.edit({player, pos, world::SetBlock{contentBlock(name)}, {}});
    };
    ASSERT_EQ(set({9, 5, kGroundHeight}, "water", kNeighbor), EditResult::Applied);
    for (int k = 0; k < 40; ++k) session_.advance(0.25, {0, 0});
    EXPECT_GT(changed[kNeighbor], 20u);
    EXPECT_EQ(changed[kNoPlayer], 0u);
    // Who breaks the source causes what runs dry.
    const std::size_t flooded = changed[kNeighbor];
    ASSERT_EQ(set({9, 5, kGroundHeight}, "air", kOperator), EditResult::Applied);
    for (int k = 0; k < 80; ++k) session_.advance(0.25, {0, 0});
    EXPECT_EQ(changed[kNeighbor], flooded);
    EXPECT_GT(changed[kOperator], 20u);
    EXPECT_EQ(at({10, 5, kGroundHeight}), world::kAir);
}

TEST_F(PermissionsTest, TheWorldItselfMayEverything) {
    EXPECT_EQ(put(kInClaim, kNoPlayer), EditResult::Applied);
}

TEST(Claims, DoNotOverlapAndHaveNames) {
    Claims claims;
    ASSERT_TRUE(claims.add({"a", {0, 0, 9, 9}, kOwner, {}}));
    EXPECT_FALSE(claims.add({"a", {20, 20, 29, 29}, kOwner, {}})) << "the name is in use";
    EXPECT_FALSE(claims.add({"b", {9, 9, 12, 12}, kNeighbor, {}})) << "a corner is in a";
    EXPECT_FALSE(claims.add({"c", {12, 3, 11, 3}, kNeighbor, {}})) << "empty";
    ASSERT_TRUE(claims.add({"d", {10, 0, 19, 9}, kNeighbor, {}}));
    EXPECT_EQ(claims.at({9, 0, 5})->name, "a");
    EXPECT_EQ(claims.at({10, 0, 200})->name, "d");
    EXPECT_EQ(claims.at({20, 0, 0}), nullptr);
    EXPECT_TRUE(claims.remove("a"));
    EXPECT_FALSE(claims.remove("a"));
    EXPECT_EQ(claims.find("a"), nullptr);
    EXPECT_EQ(claims.all().size(), 1u);
}

}  // namespace
}  // namespace terrane::game
