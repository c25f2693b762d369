// Items of a session's players: survival, chests, crafting, and what a store keeps of them.
#include <gtest/gtest.h>

#include <map>

#include "terrane/game/item_commands.h"
#include "terrane/game/item_keeper.h"
#include "terrane/game/items.h"
#include "tests/game/session_fixture.h"

namespace terrane::game {
namespace {

constexpr world::BlockPos kGround{5, 5, kGroundHeight - 1}, kAbove{5, 5, kGroundHeight},
    kItemChest{7, 5, kGroundHeight};

class SurvivalTest : public SessionTest {
  protected:
    SurvivalTest() {
        session_.setPlayer(kLocalPlayer, {.position = {5.5, 5.5, kGroundHeight + 2.0}});
        session_.mode = Mode::Survival;
        changed_ = session_.events.items.add([this](const ItemsChanged&) { ++changes_; });
    }
    void wait(double seconds) { session_.advance(seconds, world::ChunkPos{0, 0}); }
    void give(const char* item, int count = 1) {
        ASSERT_EQ(session_.give(kLocalPlayer, {item, static_cast<std::uint16_t>(count)}), 0);
    }
    EditResult set(world::BlockPos pos, const char* block) {
        return session_.edit({kLocalPlayer, pos, world::SetBlock{contentBlock(block)}, std::nullopt});
    }
    EditResult breakBlock(world::BlockPos pos) { return set(pos, "air"); }
    void putChest() {
        session_.edit({kNoPlayer, kItemChest, world::SetBlock{contentBlock("chest")}, std::nullopt});
    }
    int count(const char* item) { return world::countItems(session_.itemsOf(kLocalPlayer).slots, item); }
    world::Inventory chest() { return itemsOf(session_.world(), session_.blocks(), kItemChest).value(); }

    int changes_ = 0;
    Subscription changed_;
};

TEST_F(SurvivalTest, BreakingTakesTimeAndGivesWhatTheToolAllows) {
    EXPECT_EQ(breakBlock(kGround), EditResult::TooSoon);
    wait(7);
    EXPECT_EQ(breakBlock(kGround), EditResult::Applied);
    EXPECT_EQ(count("cobble"), 0) << "stone needs a pick";
    give("wooden_pick");
    const world::BlockPos next{6, 5, kGroundHeight - 1};
    EXPECT_EQ(breakBlock(next), EditResult::TooSoon);
    wait(3);
    EXPECT_EQ(breakBlock(next), EditResult::Applied) << "a wooden pick is twice as fast";
    EXPECT_EQ(count("cobble"), 1);
    EXPECT_EQ(session_.itemsOf(kLocalPlayer).hand().wear, 1);
}

// Whoever sends commands as fast as possible breaks no more blocks than the time allows.
TEST_F(SurvivalTest, NoCommandsAreFasterThanTheTool) {
    give("iron_pick");
    wait(60);
    int broken = 0;
    for (int tick = 0; tick < 200; ++tick) {  // ten seconds, one for each block
        wait(0.05);
        const world::BlockPos pos{tick % 8, 3 + tick / 8 % 5, kGroundHeight - 1};
        if (session_.world().block(pos) != world::kAir && breakBlock(pos) == EditResult::Applied) ++broken;
    }
    EXPECT_GE(broken, 9);
    EXPECT_LE(broken, 11);
}

TEST_F(SurvivalTest, PlacingTakesTheBlockFromTheHand) {
    EXPECT_EQ(set(kAbove, "dirt"), EditResult::NoItem);
    give("dirt", 2);
    EXPECT_EQ(set(kAbove, "stone"), EditResult::NoItem) << "the hand holds dirt";
    EXPECT_EQ(set(kGround, "dirt"), EditResult::Conflict) << "there is stone";
    EXPECT_EQ(set(kAbove, "dirt"), EditResult::Applied);
    EXPECT_EQ(count("dirt"), 1);
    session_.act(kLocalPlayer, SelectSlot{1});
    EXPECT_EQ(set({5, 4, kGroundHeight}, "dirt"), EditResult::NoItem) << "the slot is empty";
    EXPECT_EQ(session_.act(kLocalPlayer, SelectSlot{9}), EditResult::BadData);
}

TEST_F(SurvivalTest, WithoutRoomNothingBreaks) {
    give("dirt", 99 * static_cast<int>(kCarriedSlots));
    session_.edit({kNoPlayer, kAbove, world::SetBlock{contentBlock("sand")}, std::nullopt});
    wait(5);
    EXPECT_EQ(breakBlock(kAbove), EditResult::NoRoom);
    EXPECT_EQ(session_.world().block(kAbove), contentBlock("sand"));
    session_.take(kLocalPlayer, "dirt", 99);
    EXPECT_EQ(breakBlock(kAbove), EditResult::Applied);
    EXPECT_EQ(count("sand"), 1);
}

TEST_F(SurvivalTest, ToolsOfCreativeAreRefused) {
    const FillBox fill{{kAbove, kAbove}, contentBlock("stone"), 0, {}};
    EXPECT_EQ(session_.build({kLocalPlayer, fill}).result, BuildOutcome::Result::NotAllowed);
    give("dirt");
    ASSERT_EQ(set(kAbove, "dirt"), EditResult::Applied);
    EXPECT_EQ(session_.undoOrRedo(kLocalPlayer, HistoryWay::Undo).outcome, UndoResult::Outcome::NotAllowed);
    putChest();
    const world::Inventory gold{{"gold_ore", 99}};
    EXPECT_EQ(putItems(session_, kLocalPlayer, kItemChest, gold), EditResult::Creative);
    session_.setMode(kLocalPlayer, Mode::Creative);
    EXPECT_EQ(putItems(session_, kLocalPlayer, kItemChest, world::Inventory(27)), EditResult::Applied);
    EXPECT_EQ(session_.undoOrRedo(kLocalPlayer, HistoryWay::Undo).outcome, UndoResult::Outcome::Done);
}

TEST_F(SurvivalTest, StacksMoveBetweenPlayerAndChest) {
    putChest();
    give("coal", 50);
    const SlotPlace own{{}, 0}, other{kItemChest, 3};
    EXPECT_EQ(session_.act(kLocalPlayer, MoveStack{own, other, 20}), EditResult::Applied);
    EXPECT_EQ(count("coal"), 30);
    EXPECT_EQ(chest()[3], (world::ItemStack{"coal", 20}));
    EXPECT_EQ(session_.act(kLocalPlayer, MoveStack{other, {kItemChest, 26}, 20}), EditResult::Applied);
    EXPECT_EQ(chest()[26].count, 20);
    EXPECT_EQ(session_.act(kLocalPlayer, MoveStack{other, own, 1}), EditResult::Unchanged);
    EXPECT_EQ(session_.act(kLocalPlayer, MoveStack{{kItemChest, 27}, own, 1}), EditResult::BadData);
    EXPECT_EQ(session_.act(kLocalPlayer, MoveStack{own, {kGround, 0}, 1}), EditResult::Conflict);
    EXPECT_EQ(session_.act(kLocalPlayer, MoveStack{{kItemChest, 26}, {{}, 44}, 99}), EditResult::Applied);
    EXPECT_EQ(count("coal"), 50);
    session_.setPlayer(kLocalPlayer, {.position = {100, 5, kGroundHeight}});
    EXPECT_EQ(session_.act(kLocalPlayer, MoveStack{own, other, 1}), EditResult::OutOfReach);
    EXPECT_EQ(count("coal"), 50) << "a refused move changes nothing";
}

TEST_F(SurvivalTest, AGuestTakesNothing) {
    putChest();
    give("coal", 5);
    session_.permissions.roles[kLocalPlayer] = Role::Guest;
    EXPECT_EQ(session_.act(kLocalPlayer, MoveStack{{{}, 0}, {kItemChest, 0}, 5}), EditResult::NotAllowed);
    EXPECT_EQ(count("coal"), 5);
    EXPECT_EQ(chest(), world::Inventory(27));
}

TEST_F(SurvivalTest, CraftingAndEatingAreTold) {
    std::string told;
    const auto crafted = session_.events.crafted.add([&](const ItemsCrafted& event) {
        told += event.made.item + " " + std::to_string(event.made.count) + ";";
    });
    const auto used = session_.events.itemUsed.add([&](const ItemUsed& event) { told += event.item + ";"; });
    give("oak_log");
    EXPECT_EQ(session_.act(kLocalPlayer, CraftItems{}), EditResult::Unchanged);
    session_.act(kLocalPlayer, MoveStack{{{}, 0}, {{}, 36}, 1});
    EXPECT_EQ(session_.act(kLocalPlayer, CraftItems{kGround}), EditResult::Conflict) << "no workbench";
    EXPECT_EQ(session_.act(kLocalPlayer, CraftItems{}), EditResult::Applied);
    EXPECT_EQ(session_.act(kLocalPlayer, UseItem{}), EditResult::NoItem) << "planks are placed";
    session_.take(kLocalPlayer, "oak_planks", 4);
    give("bread", 2);
    EXPECT_EQ(session_.act(kLocalPlayer, UseItem{}), EditResult::Applied);
    EXPECT_EQ(count("bread"), 1);
    EXPECT_EQ(told, "oak_planks 4;bread;");
}

TEST_F(SurvivalTest, CommandsGiveAndSetModes) {
    std::vector<std::string> lines;
    const auto said = session_.events.said.add([&](const Said& line) { lines.push_back(line.text); });
    bool may = true;
    const ItemCommands commands(session_, [&](PlayerId) { return may; });
    session_.events.joined.notify({kLocalPlayer, "Ann Lee"});
    for (const char* line :
         {"give torch 5", "give torch", "give spoon", "give torch 5 Ann Lee", "give torch 0",
          "give torch 1 Bob", "give", "mode creative", "mode hard", "mode world Ann Lee"})
        EXPECT_TRUE(runChatCommand(session_, kLocalPlayer, line));
    EXPECT_EQ(count("torch"), 11);
    may = false;
    EXPECT_TRUE(runChatCommand(session_, kLocalPlayer, "give torch"));
    EXPECT_TRUE(runChatCommand(session_, kLocalPlayer, "mode creative"));
    const std::vector<std::string> expected{"gave 5 torch",
                                            "gave 1 torch",
                                            "there is no item spoon",
                                            "gave 5 torch",
                                            "a count from 1 to 999, not 0",
                                            "no player called Bob is here",
                                            "usage: /give ITEM [COUNT] [PLAYER]",
                                            "you are in creative",
                                            "usage: /mode creative|survival|world [PLAYER]",
                                            "Ann Lee is in survival",
                                            "only operators can give items",
                                            "only operators can set modes"};
    EXPECT_EQ(lines, expected);
}

// A store that stands still after each transaction, as after a crash: blocks and items are those of the same
// moment.
TEST_F(SurvivalTest, TheStoreHasBlocksAndItemsTogether) {
    const ItemKeeper keeper(session_);
    session_.mode = Mode::Survival;
    give("iron_pick");
    give("dirt", 3);
    session_.act(kLocalPlayer, SelectSlot{1});
    ASSERT_EQ(set(kAbove, "dirt"), EditResult::Applied);
    const auto text = session_.store().metadata("items");
    ASSERT_TRUE(text);
    EXPECT_EQ(parsePlayerItems(*text).value().slots, session_.itemsOf(kLocalPlayer).slots);
    EXPECT_EQ(session_.store().load({0, 0}).chunk->block(world::blockIndex(kAbove)), contentBlock("dirt"))
        << "the block is in the store with the items";
    Session later(flatParts());
    later.store().setMetadata("items", *text);
    saveMode(later.store(), Mode::Survival);
    const ItemKeeper read(later);
    EXPECT_EQ(later.mode, Mode::Survival);
    EXPECT_EQ(later.itemsOf(kLocalPlayer).slots, session_.itemsOf(kLocalPlayer).slots);
}

}  // namespace
}  // namespace terrane::game
