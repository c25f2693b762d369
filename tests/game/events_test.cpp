#include "terrane/game/events.h"

#include <gmock/gmock.h>

#include "terrane/game/chat.h"
#include "tests/game/session_fixture.h"

namespace terrane::game {
namespace {

using testing::ElementsAre;

TEST(Listeners, AreCalledInTheOrderOfSubscription) {
    Listeners<Ticked> listeners;
    std::string calls;
    const auto adds = [&](char letter) { return [&calls, letter](Ticked&) { calls += letter; }; };
    const Subscription a = listeners.add(adds('a'));
    std::optional<Subscription> b = listeners.add(adds('b'));
    const Subscription c = listeners.add(adds('c'));
    listeners.notify({});
    b.reset();
    listeners.notify({});
    b = listeners.add(adds('B'));
    listeners.notify({});
    EXPECT_EQ(calls, "abcacacB");
}

TEST(Listeners, MayComeAndGoWhileAnEventIsTold) {
    Listeners<Ticked> listeners;
    std::string calls;
    std::optional<Subscription> second, third;
    const Subscription first = listeners.add([&](Ticked&) {
        calls += '1';
        second.reset();
        if (!third) third = listeners.add([&](Ticked&) { calls += '3'; });
    });
    second = listeners.add([&](Ticked&) { calls += '2'; });
    listeners.notify({});
    EXPECT_EQ(calls, "1");
    listeners.notify({});
    EXPECT_EQ(calls, "113");
}

TEST(Listeners, SubscriptionsOutliveThem) {
    Subscription kept;
    {
        Listeners<Ticked> listeners;
        kept = listeners.add([](Ticked&) {});
    }
    kept = {};
}

class EventsTest : public SessionTest {
  protected:
    EventsTest() {
        session_.setPlayer(kLocalPlayer, {.position = {5.5, 5.5, kGroundHeight + 2.0}});
        said_ = session_.events.said.add([this](const Said& line) { lines_.push_back(line.text); });
        acted_ = session_.events.block.add([this](const BlockAction& action) { actions_.push_back(action); });
        built_ = session_.events.build.add([this](const BuildAction& action) { builds_.push_back(action); });
    }
    EditResult set(world::BlockPos pos, std::string_view name, PackId pack = kNoPack) {
        return session_.edit({kLocalPlayer, pos, world::SetBlock{contentBlock(name)}, {}, pack});
    }

    std::vector<std::string> lines_;
    std::vector<BlockAction> actions_;
    std::vector<BuildAction> builds_;
    Subscription said_, acted_, built_;
};

const world::BlockPos kFree{5, 5, kGroundHeight};
const world::BlockPos kStone{5, 5, kGroundHeight - 1};

TEST_F(EventsTest, PlayersActionsAreTold) {
    set(kFree, "oak_door");
    session_.edit({kLocalPlayer, kFree, world::UseBlock{}, {}});
    set(kStone, "air");
    set(kStone, "air");
    ASSERT_EQ(actions_.size(), 3u) << "what changes nothing is no action";
    EXPECT_EQ(actions_[0].act, BlockAct::Place);
    EXPECT_EQ(actions_[0].after, contentBlock("oak_door"));
    EXPECT_EQ(actions_[1].act, BlockAct::Use);
    EXPECT_EQ(actions_[2].act, BlockAct::Break);
    EXPECT_EQ(actions_[2].pos, kStone);
    EXPECT_EQ(actions_[2].before, contentBlock("stone"));
}

TEST_F(EventsTest, TheFirstRefusalDecides) {
    std::string asked;
    const Subscription first = session_.events.beforeBlock.add([&](BeforeBlockAction& event) {
        asked += '1';
        if (event.after == contentBlock("sand")) event.refusal = "no sand here";
    });
    const Subscription second = session_.events.beforeBlock.add([&](BeforeBlockAction&) { asked += '2'; });
    EXPECT_EQ(set(kFree, "sand"), EditResult::Refused);
    EXPECT_EQ(session_.world().block(kFree), world::kAir);
    EXPECT_THAT(lines_, ElementsAre("no sand here"));
    EXPECT_EQ(set(kFree, "glass"), EditResult::Applied);
    EXPECT_EQ(asked, "112");
    EXPECT_EQ(actions_.size(), 1u);
}

TEST_F(EventsTest, PacksAreNotAskedAndReachFar) {
    const Subscription refusing =
        session_.events.beforeBlock.add([](BeforeBlockAction& event) { event.refusal = "never"; });
    const Subscription hearing = session_.events.changed.add([&](const BlocksChanged& event) {
        EXPECT_EQ(event.author, (Author{kLocalPlayer, 1}));
    });
    EXPECT_EQ(set({25, 25, kGroundHeight}, "sand", 1), EditResult::Applied);
    EXPECT_TRUE(actions_.empty());
    EXPECT_EQ(session_.undoOrRedo(kLocalPlayer, HistoryWay::Undo).outcome, UndoResult::Outcome::NoStep);
}

TEST_F(EventsTest, APackThatActsForAPlayerKeepsToClaims) {
    ASSERT_TRUE(session_.permissions.claims.add({"garden", {5, 5, 5, 5}, 9, {}}));
    EXPECT_EQ(set(kFree, "sand", 1), EditResult::Claimed);
    EXPECT_EQ(session_.edit({kNoPlayer, kFree, world::SetBlock{contentBlock("sand")}, {}, 1}),
              EditResult::Applied);
}

TEST_F(EventsTest, BuildsAndUndoAreToldAndRefused) {
    const FillBox fill{{kFree, {6, 5, kGroundHeight}}, contentBlock("sand"), 0, {}};
    EXPECT_EQ(session_.build({kLocalPlayer, fill}).result, BuildOutcome::Result::Done);
    EXPECT_EQ(session_.undoOrRedo(kLocalPlayer, HistoryWay::Undo).outcome, UndoResult::Outcome::Done);
    ASSERT_EQ(builds_.size(), 2u);
    EXPECT_EQ(builds_[0].act, BuildAct::Fill);
    EXPECT_EQ(builds_[0].blocks, 2u);
    EXPECT_EQ(builds_[1].act, BuildAct::Undo);
    EXPECT_EQ(builds_[1].box.low, kFree);
    EXPECT_EQ(builds_[1].box.high, (world::BlockPos{6, 5, kGroundHeight}));
    const Subscription refusing =
        session_.events.beforeBuild.add([](BeforeBuildAction& event) { event.refusal = "no building"; });
    EXPECT_EQ(session_.undoOrRedo(kLocalPlayer, HistoryWay::Redo).outcome, UndoResult::Outcome::Refused);
    EXPECT_EQ(session_.build({kLocalPlayer, fill}).result, BuildOutcome::Result::Refused);
    EXPECT_EQ(session_.world().block(kFree), world::kAir);
    EXPECT_THAT(lines_, ElementsAre("no building", "no building"));
}

TEST_F(EventsTest, TicksAndRandomTicksComeWithTime) {
    std::vector<std::uint64_t> ticks;
    std::set<world::BlockId> kinds;
    std::size_t picked = 0;
    const Subscription ticking =
        session_.events.tick.add([&](const Ticked& event) { ticks.push_back(event.tick); });
    const Subscription random = session_.events.randomTick.add([&](const RandomTicked& event) {
        ++picked;
        kinds.insert(event.block);
        EXPECT_EQ(session_.world().block(event.pos), event.block);
    });
    session_.advance(0.1, {0, 0});
    EXPECT_THAT(ticks, ElementsAre(0, 1));
    EXPECT_EQ(picked, 0u) << "nobody asks for blocks";
    session_.events.randomTickBlocks.insert(contentBlock("stone"));
    session_.advance(0.05, {0, 0});
    // 49 chunks of 4 sections of stone, 3 picks each; a block is picked once.
    EXPECT_GT(picked, 500u);
    EXPECT_LE(picked, 588u);
    EXPECT_THAT(kinds, ElementsAre(contentBlock("stone")));
}

TEST_F(EventsTest, CommandsAnswerAndCanBeRefused) {
    std::vector<std::string> ran;
    session_.chatCommands.push_back({"greet", "NAME", "greets", [&](PlayerId, const std::string& arguments) {
                                         ran.push_back(arguments);
                                         return "hello " + arguments;
                                     }});
    EXPECT_TRUE(runChatCommand(session_, kLocalPlayer, "greet  the world"));
    EXPECT_TRUE(runChatCommand(session_, kLocalPlayer, "greet"));
    EXPECT_FALSE(runChatCommand(session_, kLocalPlayer, "gree"));
    EXPECT_FALSE(runChatCommand(session_, kLocalPlayer, ""));
    EXPECT_THAT(ran, ElementsAre("the world", ""));
    const Subscription refusing =
        session_.events.beforeCommand.add([](BeforeCommand& event) { event.refusal = "not now"; });
    EXPECT_TRUE(runChatCommand(session_, kLocalPlayer, "greet you"));
    EXPECT_EQ(ran.size(), 2u);
    EXPECT_THAT(lines_, ElementsAre("hello the world", "hello ", "not now"));
    EXPECT_EQ(chatHelp(session_.chatCommands), "/greet NAME: greets");
}

TEST_F(EventsTest, ChatCanBeRefused) {
    const Subscription refusing = session_.events.beforeChat.add([](BeforeChat& event) {
        if (event.text == "rude") event.refusal = "be kind";
    });
    EXPECT_TRUE(mayChat(session_, kLocalPlayer, "hello"));
    EXPECT_FALSE(mayChat(session_, kLocalPlayer, "rude"));
    EXPECT_THAT(lines_, ElementsAre("be kind"));
}

}  // namespace
}  // namespace terrane::game
