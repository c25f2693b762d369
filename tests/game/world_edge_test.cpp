// Play at the four corners of the world, where coordinates are the first and last 32-bit numbers. Under the
// sanitizers, an overflow ends the test.
#include <algorithm>
#include <limits>

#include "terrane/game/block_interaction.h"
#include "terrane/game/build_command.h"
#include "terrane/game/selection.h"
#include "terrane/game/sounds.h"
#include "tests/game/session_fixture.h"

namespace terrane::game {
namespace {

using world::BlockPos;

constexpr std::int32_t kFirstColumn = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kLastColumn = std::numeric_limits<std::int32_t>::max();
constexpr PlayerId kVisitor = 7;

struct WorldCorner {
    std::int32_t x = 0, y = 0;
    // The block so far from the corner, toward the middle of the world.
    BlockPos inward(std::int32_t dx, std::int32_t dy, std::int32_t z) const {
        return {x < 0 ? x + dx : x - dx, y < 0 ? y + dy : y - dy, z};
    }
};

class WorldEdgeTest : public SessionTest, public testing::WithParamInterface<WorldCorner> {
  protected:
    WorldEdgeTest() {
        load(3, world::chunkOf(corner(0)));
        session_.setPlayer(kVisitor, {.position = eyes()});
    }
    BlockPos corner(std::int32_t z) const { return GetParam().inward(0, 0, z); }
    BlockPos inward(std::int32_t dx, std::int32_t dy, std::int32_t z) const {
        return GetParam().inward(dx, dy, z);
    }
    glm::dvec3 eyes() const {
        const BlockPos at = inward(3, 3, kGroundHeight + 2);
        return {at.x + 0.5, at.y + 0.5, at.z};
    }
    void put(BlockPos pos, std::string_view name) {
        EXPECT_EQ(session_.edit({kNoPlayer, pos, world::SetBlock{contentBlock(name)}, {}}),
                  EditResult::Applied);
    }
};

// The box from the corner to a block that lies 3 columns inward.
TEST_P(WorldEdgeTest, BoxesAreFilledTakenBackAndCopied) {
    const BlockPos a = corner(kGroundHeight), b = inward(3, 3, kGroundHeight + 1);
    const world::BlockBox box{{std::min(a.x, b.x), std::min(a.y, b.y), a.z},
                              {std::max(a.x, b.x), std::max(a.y, b.y), b.z}};
    const BuildOutcome outcome = session_.build({kVisitor, FillBox{box, contentBlock("sand"), 0, {}}});
    ASSERT_EQ(outcome.result, BuildOutcome::Result::Done);
    EXPECT_EQ(outcome.changed, 32u);
    EXPECT_EQ(session_.world().block(a), contentBlock("sand"));
    EXPECT_EQ(session_.world().block(b), contentBlock("sand"));

    const auto structure =
        std::make_shared<const world::Structure>(world::copyBlocks(session_.world(), session_.blocks(), box));
    EXPECT_EQ(session_.undoOrRedo(kVisitor, HistoryWay::Undo).blocks, 32u);
    EXPECT_EQ(session_.world().block(a), world::kAir);
    EXPECT_EQ(session_.build({kVisitor, PlaceStructure{structure, box.low}}).changed, 32u);

    Selection selection;
    selection.setClipboard(*structure);
    (void)selection.pasteCorner(a, {});  // may lie outside; placing it there is refused
    const BuildOutcome cut = session_.build({kVisitor, PlaceStructure{structure, a}});
    EXPECT_EQ(cut.result, GetParam().x < 0 && GetParam().y < 0 ? BuildOutcome::Result::Done
                                                               : BuildOutcome::Result::OutOfWorld);
}

TEST_P(WorldEdgeTest, ShapesReachTheLastColumn) {
    const BlockPos a = corner(kGroundHeight), b = inward(4, 4, kGroundHeight + 4);
    Selection selection;
    selection.setFirst(a);
    selection.setSecond(b);
    const auto count = [&](ShapeKind kind) {
        selection.setShape(kind);
        const FillBox fill{*selection.box(), contentBlock("glass"), 0, {}, selection.shape()};
        const std::size_t changed = session_.build({kVisitor, fill}).changed;
        const bool hasCorner = session_.world().block(a) == contentBlock("glass");
        EXPECT_EQ(hasCorner, kind != ShapeKind::Sphere);
        EXPECT_EQ(session_.undoOrRedo(kVisitor, HistoryWay::Undo).blocks, changed);
        return changed;
    };
    EXPECT_EQ(count(ShapeKind::Solid), 125u);
    EXPECT_EQ(count(ShapeKind::Hollow), 98u);
    EXPECT_EQ(count(ShapeKind::Walls), 80u);
    EXPECT_EQ(count(ShapeKind::Sphere), 81u);
    EXPECT_EQ(count(ShapeKind::Line), 5u);
}

TEST_P(WorldEdgeTest, WaterAndPlantsLiveToTheLastColumn) {
    put(corner(kGroundHeight), "stone");
    put(corner(kGroundHeight + 1), "water");
    put(inward(2, 2, kGroundHeight + 3), "water");
    put(inward(1, 0, kGroundHeight), "dirt");
    put(inward(1, 0, kGroundHeight + 1), "poppy");
    for (int k = 0; k < 400; ++k) session_.advance(0.25, world::chunkOf(corner(0)));
    EXPECT_EQ(session_.world().block(corner(kGroundHeight + 1)), contentBlock("water"));
    EXPECT_EQ(session_.world().block(inward(2, 2, kGroundHeight)), contentBlock("water"));
    put(corner(kGroundHeight), "air");
    settle();
}

TEST_P(WorldEdgeTest, PlayersWalkLookBuildAndHear) {
    for (float yaw = 0; yaw < 360; yaw += 45) {
        Player player({.position = eyes(), .yaw = yaw, .pitch = -30}, Movement::Walk);
        BlockInteraction interaction{contentBlocks()};
        selectBlock(interaction.hotbar, contentBlock("sand"));
        for (int k = 0; k < 200; ++k) {
            player.move(session_.world(), session_.blocks(), {.forward = true, .jump = k % 3 == 0}, 0.05);
            session_.setPlayer(kVisitor, player.pose());
            interaction.building.press();
            interaction.act(session_, kVisitor, player, 0.01);
            interaction.building.release();
            (void)ambienceAt(session_.world(), session_.blocks(), player.pose().position, 0);
        }
        player.placeAt(player.pose(), Movement::Noclip);
        for (int k = 0; k < 100; ++k)
            player.move(session_.world(), session_.blocks(), {.forward = true}, 0.25);
        EXPECT_LE(std::abs(player.pose().position.x), 2147483648.0);
        EXPECT_LE(std::abs(player.pose().position.y), 2147483648.0);
    }
}

// Nothing stops a player outside of the world, nor moves one away from its last column.
TEST_P(WorldEdgeTest, FlightThroughBlocksReachesTheLastColumn) {
    const BlockPos at = corner(100), before = inward(40, 40, 100);
    const float outward = at.x < 0 ? (at.y < 0 ? 225.0f : 135.0f) : at.y < 0 ? 315.0f : 45.0f;
    for (const BlockPos start : {at, before}) {
        Player player({.position = {start.x + 0.5, start.y + 0.5, start.z}, .yaw = outward},
                      Movement::Noclip);
        for (int k = 0; k < 40; ++k)
            player.move(session_.world(), session_.blocks(), {.forward = true}, 0.25);
        const glm::dvec3 end = player.pose().position;
        EXPECT_EQ(world::blockOf(end), at);
        EXPECT_EQ(world::blockOf(glm::round(end * 64.0) / 64.0), at) << "messages round to 1/64 block";
    }
}

INSTANTIATE_TEST_SUITE_P(Corners, WorldEdgeTest,
                         testing::Values(WorldCorner{kFirstColumn, kFirstColumn},
                                         WorldCorner{kFirstColumn, kLastColumn},
                                         WorldCorner{kLastColumn, kFirstColumn},
                                         WorldCorner{kLastColumn, kLastColumn}));

}  // namespace
}  // namespace terrane::game
