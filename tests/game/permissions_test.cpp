#include "terrane/game/permissions.h"

#include <gtest/gtest.h>

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

TEST_F(PermissionsTest, NobodyUndoesWhatBecameAClaimOfOthers) {
    ASSERT_EQ(put(kOutside, kNeighbor), EditResult::Applied);
    ASSERT_TRUE(session_.permissions.claims.add({"later", {6, 0, 9, 9}, kOwner, {}}));
    EXPECT_EQ(session_.takeBack(kNeighbor, HistoryWay::Undo).outcome, TakenBack::Outcome::NotAllowed);
    EXPECT_EQ(at(kOutside), contentBlock("glass"));
    session_.permissions.claims.remove("later");
    EXPECT_EQ(session_.takeBack(kNeighbor, HistoryWay::Undo).outcome, TakenBack::Outcome::Done);
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
