#include "terrane/game/selection.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/default_heights.h"
#include "tests/world/content_blocks.h"

namespace terrane::game {
namespace {

using world::BlockPos;
using world::MirrorAxis;
using world::Structure;

Structure row() {
    return {.size = {3, 1, 2},
            .palette = {{"stone", 0}, {"oak_stairs", 0}},
            .cells = {0, 0, 1, 0, 0, 0},
            .data = {}};
}

TEST(Selection, ABoxGoesFromCornerToCorner) {
    Selection selection;
    EXPECT_FALSE(selection.box());
    selection.setFirst({5, -2, 9});
    ASSERT_TRUE(selection.box());
    EXPECT_EQ(selection.box()->blockCount(), 1);
    selection.setSecond({-3, 4, 8});
    EXPECT_EQ(selection.box()->low, (BlockPos{-3, -2, 8}));
    EXPECT_EQ(selection.box()->high, (BlockPos{5, 4, 9}));
}

TEST(Selection, TheEndsOfTheBoxMoveUpAndDown) {
    using End = Selection::End;
    Selection selection;
    EXPECT_FALSE(selection.moveEnd(End::Top, 1, {})) << "no box";
    selection.setFirst({0, 0, 70});
    EXPECT_TRUE(selection.moveEnd(End::Top, 4, {}));
    EXPECT_EQ(selection.box()->low.z, 70);
    EXPECT_EQ(selection.box()->high.z, 74);
    EXPECT_TRUE(selection.moveEnd(End::Bottom, -2, {}));
    EXPECT_EQ(selection.box()->low.z, 68);
    EXPECT_TRUE(selection.moveEnd(End::Top, -99, {})) << "to a single layer";
    EXPECT_EQ(selection.box()->high.z, 68);
    EXPECT_FALSE(selection.moveEnd(End::Bottom, 1, {}));
    EXPECT_TRUE(selection.moveEnd(End::Top, 9999, {}));
    EXPECT_EQ(selection.box()->high.z, world::kChunkHeight - 1);
    EXPECT_TRUE(selection.moveEnd(End::Bottom, std::numeric_limits<int>::min(), {}));
    EXPECT_EQ(selection.box()->low.z, 0);
    EXPECT_FALSE(selection.moveEnd(End::Top, std::numeric_limits<int>::max(), {}));
    EXPECT_EQ(selection.box()->blockCount(), world::kChunkHeight);
    selection.setSecond({0, 0, 400});  // a player flies there
    EXPECT_TRUE(selection.moveEnd(End::Top, -1, {}));
    EXPECT_FALSE(selection.moveEnd(End::Top, 0, {}));
    EXPECT_EQ(selection.box()->high.z, 399);
}

TEST(Selection, ALineGoesFromTheFirstCornerToTheSecond) {
    Selection selection;
    selection.setShape(ShapeKind::Line);
    selection.setFirst({5, 0, 70});
    EXPECT_EQ(selection.shape(), (FillShape{ShapeKind::Line}));
    selection.setSecond({0, 5, 75});
    EXPECT_EQ(selection.shape(), (FillShape{ShapeKind::Line, true, false}));
    selection.setShape(ShapeKind::Walls);
    EXPECT_EQ(selection.shape(), (FillShape{ShapeKind::Walls}));
}

TEST(Selection, NothingIsPastedThatWasNotCopied) {
    Selection selection;
    EXPECT_FALSE(selection.beginPaste());
    EXPECT_FALSE(selection.isPasting());
    EXPECT_FALSE(selection.pasteCorner({0, 0, 0}, {}));
    selection.turn(contentBlocks());
    selection.mirror(contentBlocks(), 0);
    EXPECT_FALSE(selection.clipboard());
    selection.setClipboard(row());
    EXPECT_TRUE(selection.beginPaste());
    EXPECT_TRUE(selection.isPasting());
    selection.endPaste();
    EXPECT_FALSE(selection.isPasting());
    EXPECT_TRUE(selection.clipboard()) << "it may be pasted again";
}

TEST(Selection, FourTurnsAndTwoMirrorsAreNone) {
    Selection selection;
    selection.setClipboard(row());
    for (int turn = 0; turn < 4; ++turn) {
        selection.turn(contentBlocks());
        EXPECT_EQ(*selection.clipboard() == row(), turn == 3);
    }
    selection.mirror(contentBlocks(), 90);
    EXPECT_EQ(selection.clipboard()->cells[0], 0u);
    EXPECT_EQ(selection.clipboard()->palette[0].name, "oak_stairs") << "+x became -x";
    selection.mirror(contentBlocks(), 90);
    EXPECT_TRUE(*selection.clipboard() == row());
}

TEST(Selection, LeftAndRightAreThoseOfWhoLooks) {
    for (const float yaw : {90.0f, -90.0f, 120.0f}) EXPECT_EQ(sidewaysAxis(yaw), MirrorAxis::X);
    for (const float yaw : {0.0f, 180.0f, 10.0f}) EXPECT_EQ(sidewaysAxis(yaw), MirrorAxis::Y);
}

TEST(Selection, APasteStandsOnTheBlockAndStaysInTheWorld) {
    Selection selection;
    selection.setClipboard(row());
    EXPECT_EQ(selection.pasteCorner({10, 20, 30}, {}), (BlockPos{9, 20, 30}));
    EXPECT_EQ(selection.pasteCorner({10, 20, 255}, {}), (BlockPos{9, 20, 254}));
    EXPECT_EQ(selection.pasteCorner({10, 20, -1}, {}), (BlockPos{9, 20, 0}));
}

}  // namespace
}  // namespace terrane::game
