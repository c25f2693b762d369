// Items of players on a server: it decides, keeps them with the blocks, and tells each player its own.
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "terrane/game/items.h"
#include "tests/net/server_fixture.h"

namespace terrane::net {
namespace {

class ServerItems : public testing::Test {
  protected:
    static world::BlockPos beside(const TestPlayer& player, int dx) {
        const world::BlockPos eyes = world::blockOf(player.pose.position);
        return {eyes.x + dx, eyes.y, eyes.z + 2};
    }
    static game::PlayerId idOf(TestServer& server, const std::string& name) {
        return server.state().clients.known.byName(name)->id;
    }
    // Puts players into survival, which tells them.
    static void beginSurvival(TestServer& server, std::initializer_list<const char*> names) {
        for (const char* name : names)
            server.state().session.setMode(idOf(server, name), game::Mode::Survival);
    }
    // By a player in creative, so that the history has it.
    static void putChest(TestServer& server, const char* player, world::BlockPos pos) {
        game::Session& session = server.state().session;
        const game::PlayerId id = idOf(server, player);
        const auto mode = session.itemsOf(id).mode;
        (void)session.pipeline().chunkAt(world::chunkOf(pos));
        session.setMode(id, game::Mode::Creative);
        ASSERT_EQ(session.edit({id, pos, world::SetBlock{contentBlock("chest")}, std::nullopt}),
                  game::EditResult::Applied);
        session.setMode(id, mode);
    }
    static world::Inventory chestOf(TestServer& server, world::BlockPos pos) {
        (void)server.state().session.pipeline().chunkAt(world::chunkOf(pos));
        return chestOf(server.state().session, pos);
    }
    static world::Inventory chestOf(const game::Session& session, world::BlockPos pos) {
        return game::itemsOf(session.world(), session.blocks(), pos).value();
    }
    base::TempFolder folder_;
};

using Sum = std::map<std::string, int>;

void addTo(Sum& sum, const world::Inventory& slots) {
    for (const world::ItemStack& stack : slots)
        if (stack.count > 0) sum[stack.item] += stack.count;
}

TEST_F(ServerItems, AreToldToTheirPlayer) {
    TestServer server(folder_.path());
    TestPlayer ann(server, testIdentity("Ann")), bob(server, testIdentity("Bob"));
    ASSERT_TRUE(stepUntil(server, {&ann, &bob}, [&] { return ann.isLoaded() && bob.isLoaded(); }));
    beginSurvival(server, {"Ann"});
    server.state().session.give(idOf(server, "Ann"), {"dirt", 3});
    step(server, {&ann, &bob});
    EXPECT_EQ(ann.session->modeOf(game::kLocalPlayer), game::Mode::Survival);
    EXPECT_EQ(ann.session->itemsOf(game::kLocalPlayer).hand(), (world::ItemStack{"dirt", 3}));
    EXPECT_EQ(bob.session->modeOf(game::kLocalPlayer), game::Mode::Creative);
    EXPECT_EQ(bob.session->itemsOf(game::kLocalPlayer).slots, world::Inventory(game::kPlayerSlots));
    const world::BlockPos pos = beside(ann, 2);
    EXPECT_EQ(ann.put(pos, "dirt"), game::EditResult::Applied);
    EXPECT_EQ(ann.put(beside(ann, 3), "stone"), game::EditResult::NoItem);
    ASSERT_TRUE(stepUntil(server, {&ann, &bob}, [&] { return ann.world->undecidedCount() == 0; }));
    EXPECT_EQ(ann.session->itemsOf(game::kLocalPlayer).hand().count, 2);
    EXPECT_EQ(bob.block(pos), contentBlock("dirt"));
}

// What a client sends is decided by the server: a wrong request changes nothing.
TEST_F(ServerItems, WrongRequestsChangeNothing) {
    TestServer server(folder_.path());
    TestPlayer ann(server, testIdentity("Ann"));
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.isLoaded(); }));
    beginSurvival(server, {"Ann"});
    game::Session& session = server.state().session;
    const game::PlayerId id = idOf(server, "Ann");
    session.give(id, {"coal", 9});
    const world::BlockPos chest = beside(ann, 2);
    putChest(server, "Ann", chest);
    std::mt19937 random(11);
    const auto place = [&]() -> game::SlotPlace {
        game::SlotPlace at{{}, static_cast<std::uint16_t>(random() % 60)};
        if (random() % 2 == 0)
            at.block = world::BlockPos{chest.x + static_cast<int>(random() % 2), chest.y, chest.z};
        return at;
    };
    CommandNumber number = 1000;
    for (int k = 0; k < 400; ++k) {
        game::ItemAction action = game::CraftItems{chest};
        if (random() % 4 != 0)
            action = game::MoveStack{place(), place(), static_cast<std::uint16_t>(random() % 200)};
        else if (random() % 2 == 0)
            action = game::SelectSlot{static_cast<std::uint8_t>(random() % 256)};
        ann.wire->say(ItemCommand{++number, action});
        if (k % 4 == 0) step(server, {&ann});
        Sum sum;
        addTo(sum, session.itemsOf(id).slots);
        addTo(sum, chestOf(server, chest));
        ASSERT_EQ(sum, (Sum{{"coal", 9}}));
    }
    const world::Inventory gold{{"gold_ore", 99}};
    ann.wire->say(Edit{++number, chest, world::SetEntityData{world::encodeInventory(gold)}, {}});
    for (int k = 0; k < 20; ++k) step(server, {&ann});
    Sum sum;
    addTo(sum, chestOf(server, chest));
    EXPECT_EQ(sum["gold_ore"], 0);
}

// Two players who empty and fill one chest at the same time: every item is somewhere exactly once, and all
// see the same.
TEST_F(ServerItems, TwoPlayersShareAChest) {
    TestServer server(folder_.path());
    TestPlayer ann(server, testIdentity("Ann")), bob(server, testIdentity("Bob"));
    ASSERT_TRUE(stepUntil(server, {&ann, &bob}, [&] { return ann.isLoaded() && bob.isLoaded(); }));
    beginSurvival(server, {"Ann", "Bob"});
    const world::BlockPos chest = beside(ann, 1);
    putChest(server, "Ann", chest);
    game::Session& session = server.state().session;
    session.give(idOf(server, "Ann"), {"coal", 70});
    session.give(idOf(server, "Bob"), {"stick", 40});
    session.give(idOf(server, "Bob"), {"iron_pick", 2});
    step(server, {&ann, &bob});
    std::mt19937 random(3);
    for (int k = 0; k < 300; ++k) {
        for (TestPlayer* player : {&ann, &bob}) {
            game::SlotPlace own{{}, static_cast<std::uint16_t>(random() % 5)};
            game::SlotPlace other{chest, static_cast<std::uint16_t>(random() % 4)};
            if (random() % 2 == 0) std::swap(own, other);
            player->session->act(game::kLocalPlayer,
                                 game::MoveStack{own, other, static_cast<std::uint16_t>(1 + random() % 99)});
        }
        step(server, {&ann, &bob});
    }
    ASSERT_TRUE(stepUntil(server, {&ann, &bob},
                          [&] { return ann.world->undecidedCount() + bob.world->undecidedCount() == 0; }));
    step(server, {&ann, &bob});
    Sum sum;
    addTo(sum, session.itemsOf(idOf(server, "Ann")).slots);
    addTo(sum, session.itemsOf(idOf(server, "Bob")).slots);
    addTo(sum, chestOf(server, chest));
    EXPECT_EQ(sum, (Sum{{"coal", 70}, {"stick", 40}, {"iron_pick", 2}}));
    for (TestPlayer* player : {&ann, &bob}) {
        EXPECT_EQ(chestOf(*player->session, chest), chestOf(server, chest));
        EXPECT_EQ(player->session->itemsOf(game::kLocalPlayer).slots,
                  session.itemsOf(idOf(server, player->identity.name)).slots);
    }
}

// As after a crash: the world's file lacks what the server's file has. Chest and player are those of the same
// moment.
TEST_F(ServerItems, ComeBackWithTheirChest) {
    const ClientIdentity identity = testIdentity("Ann");
    world::BlockPos chest;
    Sum before;
    {
        TestServer server(folder_.path());
        TestPlayer ann(server, identity);
        ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.isLoaded(); }));
        beginSurvival(server, {"Ann"});
        game::Session& session = server.state().session;
        chest = beside(ann, 1);
        putChest(server, "Ann", chest);
        session.give(idOf(server, "Ann"), {"coal", 20});
        ASSERT_EQ(session.act(idOf(server, "Ann"), game::MoveStack{{{}, 0}, {chest, 5}, 8}),
                  game::EditResult::Applied);
        server.finishWrites();
        addTo(before, session.itemsOf(idOf(server, "Ann")).slots);
        addTo(before, chestOf(server, chest));
    }  // nothing is saved
    TestServer server(folder_.path());
    TestPlayer ann(server, identity);
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.isLoaded(); }));
    game::Session& session = server.state().session;
    EXPECT_EQ(session.modeOf(idOf(server, "Ann")), game::Mode::Survival);
    EXPECT_EQ(session.itemsOf(idOf(server, "Ann")).slots[0], (world::ItemStack{"coal", 12}));
    EXPECT_EQ(chestOf(server, chest)[5], (world::ItemStack{"coal", 8}));
    Sum after;
    addTo(after, session.itemsOf(idOf(server, "Ann")).slots);
    addTo(after, chestOf(server, chest));
    EXPECT_EQ(after, before);
}

// Writes of one command are one transaction: the thread that writes waits until the last of them.
TEST_F(ServerItems, WritesOfACommandAreOneTransaction) {
    auto records = SqliteRecords::open(folder_.path() / "w.server.sqlite", contentBlocks()).value();
    {
        const auto held = records->together();
        records->setText("a", "1");
        const auto nested = records->together();
        records->setText("b", "2");
        EXPECT_EQ(records->durable(), 0u);
        EXPECT_EQ(records->text("a").value(), "");
    }
    ASSERT_TRUE(records->flush());
    EXPECT_EQ(records->text("a").value() + records->text("b").value(), "12");
}

}  // namespace
}  // namespace terrane::net
