#include "terrane/game/edit_history.h"

#include <random>

#include "terrane/world/blocks/inventory.h"
#include "tests/game/session_fixture.h"

namespace terrane::game {
namespace {

constexpr PlayerId kAnna = 7, kBert = 8;
const world::BlockPos kPlace{5, 5, kGroundHeight};

class UndoTest : public SessionTest {
  protected:
    UndoTest() {
        for (const PlayerId player : {kAnna, kBert})
            session_.setPlayer(player, {.position = {5.5, 5.5, kGroundHeight + 2.0}});
    }
    EditResult put(world::BlockPos pos, std::string_view name, PlayerId player = kAnna) {
        return session_.edit({player, pos, world::SetBlock{contentBlock(name)}, std::nullopt});
    }
    UndoResult undo(PlayerId player = kAnna) { return session_.undoOrRedo(player, HistoryWay::Undo); }
    UndoResult redo(PlayerId player = kAnna) { return session_.undoOrRedo(player, HistoryWay::Redo); }
    std::string_view at(world::BlockPos pos) const {
        return session_.blocks().type(session_.world().block(pos)).name;
    }
    world::BlockValue value(world::BlockPos pos) const { return world::blockValue(session_.world(), pos); }
    // All blocks of a box that edits can reach or affect.
    std::vector<world::BlockValue> values() const {
        std::vector<world::BlockValue> all;
        const world::BlockBox box{{-2, -2, kGroundHeight - 8}, {13, 13, kGroundHeight + 12}};
        for (std::int64_t i = 0; i < box.blockCount(); ++i) all.push_back(value(box.blockAt(i)));
        return all;
    }
};

using Outcome = UndoResult::Outcome;

TEST_F(UndoTest, AnEditIsUndoneAndDoneAgain) {
    EXPECT_EQ(undo().outcome, Outcome::NoStep);
    put(kPlace, "sand");
    EXPECT_EQ(undo().blocks, 1u);
    EXPECT_EQ(at(kPlace), "air");
    EXPECT_EQ(undo().outcome, Outcome::NoStep);
    EXPECT_EQ(redo().blocks, 1u);
    EXPECT_EQ(at(kPlace), "sand");
    EXPECT_EQ(redo().outcome, Outcome::NoStep);
}

TEST_F(UndoTest, ANewEditForgetsWhatWasUndone) {
    put(kPlace, "sand");
    undo();
    put(kPlace, "stone");
    EXPECT_EQ(redo().outcome, Outcome::NoStep);
    EXPECT_EQ(at(kPlace), "stone");
}

// Sand that fell into a hole goes back up, and a door comes back with both halves.
TEST_F(UndoTest, WhatFollowsFromAnEditIsPartOfItsStep) {
    put({5, 5, kGroundHeight}, "sand");
    put({5, 5, kGroundHeight + 1}, "sand");
    put({6, 5, kGroundHeight}, "oak_door");
    const auto before = values();
    put({5, 5, kGroundHeight - 1}, "air");
    EXPECT_EQ(at({5, 5, kGroundHeight - 1}), "sand");
    put({6, 5, kGroundHeight}, "air");
    EXPECT_EQ(at({6, 5, kGroundHeight + 1}), "air");
    undo();
    undo();
    EXPECT_TRUE(values() == before);
}

TEST_F(UndoTest, OneCallIsOneStep) {
    std::vector<EditCommand> wall;
    for (int x = 0; x < 5; ++x)
        wall.push_back({kAnna, {x, 5, kGroundHeight}, world::SetBlock{contentBlock("stone")}, std::nullopt});
    session_.edit(wall);
    EXPECT_EQ(undo().blocks, 5u);
    EXPECT_EQ(undo().outcome, Outcome::NoStep);
}

TEST_F(UndoTest, EachPlayerUndoesItsOwnEdits) {
    put(kPlace, "sand", kAnna);
    put({6, 5, kGroundHeight}, "sand", kBert);
    undo(kAnna);
    EXPECT_EQ(at(kPlace), "air");
    EXPECT_EQ(at({6, 5, kGroundHeight}), "sand");
    EXPECT_EQ(session_.undoOrRedo(9, HistoryWay::Undo).outcome, Outcome::NoStep) << "nobody knows player 9";
}

TEST_F(UndoTest, WhatOthersChangedSinceStays) {
    put(kPlace, "stone", kAnna);
    put(kPlace, "sand", kBert);
    const UndoResult result = undo(kAnna);
    EXPECT_EQ(result.blocks, 0u);
    EXPECT_EQ(result.skipped, 1u);
    EXPECT_EQ(at(kPlace), "sand");
    EXPECT_EQ(redo(kAnna).outcome, Outcome::NoStep) << "nothing was undone";
}

TEST_F(UndoTest, AChestThatGotThingsSinceStays) {
    put(kPlace, "chest");
    const auto things = world::encodeInventory(world::Inventory(27));
    session_.edit({kBert, kPlace, world::SetEntityData{things}, std::nullopt});
    EXPECT_EQ(undo().skipped, 1u);
    EXPECT_EQ(at(kPlace), "chest");
}

TEST_F(UndoTest, ABrokenChestComesBackWithItsThings) {
    put(kPlace, "chest");
    const auto things = world::encodeInventory(world::Inventory(27));
    session_.edit({kAnna, kPlace, world::SetEntityData{things}, std::nullopt});
    put(kPlace, "air");
    undo();
    ASSERT_TRUE(session_.world().blockEntityData(kPlace));
    EXPECT_EQ(*session_.world().blockEntityData(kPlace), things);
}

// Bert hangs a ladder on Anna's wall.
TEST_F(UndoTest, WhatHangsOnAnUndoneBlockGoesAndComesBack) {
    put(kPlace, "stone");
    session_.edit({kBert, {6, 5, kGroundHeight}, world::SetBlock{contentBlock("ladder"), 1}, std::nullopt});
    ASSERT_EQ(at({6, 5, kGroundHeight}), "ladder");
    undo();
    EXPECT_EQ(at({6, 5, kGroundHeight}), "air");
    redo();
    EXPECT_EQ(at({6, 5, kGroundHeight}), "ladder");
}

TEST_F(UndoTest, AStepThatIsNotLoadedWaits) {
    put(kPlace, "sand");
    session_.pipeline().setView({100, 100}, 2);
    settle();
    session_.pipeline().update(std::chrono::steady_clock::now() + std::chrono::minutes(1));
    EXPECT_EQ(undo().outcome, Outcome::NotLoaded);
    load(2);
    EXPECT_EQ(undo().outcome, Outcome::Done);
    EXPECT_EQ(at(kPlace), "air");
}

TEST_F(UndoTest, AnUndoneEditIsOnScreenWithTheNextUpdate) {
    put(kPlace, "lamp_red");
    settle();
    takeChanges();
    undo();
    session_.pipeline().update();
    const auto changes = takeChanges();
    const auto isHere = [](const stream::ChunkChange& c) { return c.pos == world::ChunkPos{0, 0} && c.mesh; };
    EXPECT_TRUE(std::ranges::any_of(changes, isHere));
}

// Random blocks that fall, hang, stand and connect: all steps undone and redone.
TEST_F(UndoTest, RandomEditsAreUndoneAndDoneAgain) {
    std::mt19937 random(20261124);
    const auto upTo = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    std::vector<std::vector<world::BlockValue>> history = {values()};
    const std::size_t kinds = session_.blocks().types().size();
    while (history.size() < 300) {
        const world::BlockPos pos{3 + upTo(5), 3 + upTo(5), kGroundHeight - 2 + upTo(6)};
        const auto id = static_cast<world::BlockId>(upTo(3) == 0 ? 0 : random() % kinds);
        session_.edit({kAnna, pos, world::SetBlock{id, static_cast<std::uint16_t>(upTo(16))}, std::nullopt});
        auto now = values();
        if (now != history.back()) history.push_back(std::move(now));
    }
    for (std::size_t k = history.size() - 1; k-- > 0;) {
        ASSERT_EQ(undo().outcome, Outcome::Done);
        ASSERT_TRUE(values() == history[k]) << k;
    }
    for (std::size_t k = 1; k < history.size(); ++k) {
        ASSERT_EQ(redo().outcome, Outcome::Done);
        ASSERT_TRUE(values() == history[k]) << k;
    }
}

EditStep stepOf(std::size_t blocks) {
    return EditStep(blocks);
}

TEST(EditHistory, KeepsAThousandSteps) {
    EditHistory history;
    for (std::size_t k = 0; k < EditHistory::kMaxSteps + 5; ++k) history.add(stepOf(1));
    EXPECT_EQ(history.stepCount(HistoryWay::Undo), EditHistory::kMaxSteps);
}

TEST(EditHistory, ForgetsTheOldestBeyondItsMemory) {
    EditHistory history;
    history.add(stepOf(3));
    history.add(stepOf(EditHistory::kMaxBlocks));
    EXPECT_EQ(history.stepCount(HistoryWay::Undo), 1u);
    EXPECT_EQ(history.next(HistoryWay::Undo)->size(), EditHistory::kMaxBlocks);
    history.finishStep(HistoryWay::Undo, stepOf(2));
    EXPECT_EQ(history.stepCount(HistoryWay::Undo), 0u);
    EXPECT_EQ(history.next(HistoryWay::Redo)->size(), 2u);
}

}  // namespace
}  // namespace terrane::game
