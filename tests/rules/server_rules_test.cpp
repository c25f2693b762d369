// The rules of a server's world: its clients run none, read refusals and lines, and see what scripts change.
#include <gmock/gmock.h>

#include "terrane/net/server/server_console.h"
#include "terrane/rules/rules.h"
#include "tests/net/server_fixture.h"

namespace terrane::net {
namespace {

class ServerRules : public testing::Test {
  protected:
    static std::vector<pack::Pack> packWith(const std::string& script) {
        pack::Pack pack{{}, {{"scripts/main.lua", script}}, "test"};
        pack.info.name = "test";
        pack.info.rules = pack::kRulesVersion;
        return {pack};
    }
    static world::BlockPos beside(const TestPlayer& player, int dx) {
        const world::BlockPos eyes = world::blockOf(player.pose.position);
        return {eyes.x + dx, eyes.y, eyes.z + 2};
    }
    void take(TestPlayer& player) {
        for (const ChatLine& line : player.world->popChat())
            if (line.name.empty()) said_.push_back(line.text);
    }
    base::TempFolder folder_;
    std::vector<std::string> said_;
};

constexpr const char* kScript = R"(
    events.before("place", function() return "no glass" end, "glass")
    events.on("place", function(e)
        storage.set("count", (storage.get("count") or 0) + 1)
        world.set({x = e.pos.x, y = e.pos.y, z = e.pos.z + 1}, "gold_ore")
    end, "stone")
    events.before("chat", function(e) if e.text == "rude" then return "be kind" end end)
    commands.add{name = "count", help = "stones", run = function(player, args)
        return tostring(storage.get("count")) .. args
    end}
)";

TEST_F(ServerRules, AreThoseOfAllPlayers) {
    TestServer server(folder_.path());
    const rules::Rules rules(server.state().session, packWith(kScript));
    TestPlayer ann(server, testIdentity("Ann")), bob(server, testIdentity("Bob"));
    ASSERT_TRUE(stepUntil(server, {&ann, &bob}, [&] { return ann.isLoaded() && bob.isLoaded(); }));
    const world::BlockPos pos = beside(ann, 2), other = beside(ann, 3);
    const world::BlockPos gold{pos.x, pos.y, pos.z + 1};
    ASSERT_EQ(ann.put(other, "glass"), game::EditResult::Applied) << "the client predicts it";
    ASSERT_EQ(ann.put(pos, "stone"), game::EditResult::Applied);
    ASSERT_TRUE(stepUntil(server, {&ann, &bob}, [&] { return ann.world->undecidedCount() == 0; }));
    ASSERT_TRUE(stepUntil(server, {&ann, &bob}, [&] { return bob.block(gold) == contentBlock("gold_ore"); }));
    EXPECT_EQ(ann.block(gold), contentBlock("gold_ore"));
    EXPECT_EQ(ann.block(other), world::kAir) << "what the server refused is taken back";
    EXPECT_EQ(bob.block(other), world::kAir);
    ann.world->say("rude");
    ann.world->say("/count !");
    ann.world->say("/help");
    ann.world->say("/stop");
    step(server, {&ann, &bob});
    step(server, {&ann, &bob});
    take(ann);
    for (const char* line :
         {"no glass", "be kind", "1!", "/count: stones", "only operators can give commands"})
        EXPECT_EQ(std::ranges::count(said_, line), 1) << line;
    EXPECT_TRUE(
        std::ranges::none_of(bob.world->popChat(), [](const ChatLine& l) { return l.text == "rude"; }));
    EXPECT_TRUE(rules.problems().empty());
}

TEST_F(ServerRules, TheHistoryNamesPackAndPlayer) {
    world::BlockPos gold;
    {
        TestServer server(folder_.path());
        const rules::Rules rules(server.state().session, packWith(kScript));
        TestPlayer ann(server, testIdentity("Ann"));
        ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.isLoaded(); }));
        const world::BlockPos pos = beside(ann, 2);
        gold = {pos.x, pos.y, pos.z + 1};
        ASSERT_EQ(ann.put(pos, "stone"), game::EditResult::Applied);
        ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.world->undecidedCount() == 0; }));
        server.finishWork();
        const auto history = readHistoryFile(folder_.path() / "w.server.sqlite", contentBlocks());
        ASSERT_TRUE(history);
        const auto authorsOf = [&](const EditFilter& filter) {
            std::vector<std::string> authors;
            EXPECT_TRUE(history->forEachEdit(filter, EditOrder::OldestFirst,
                                             [&](const LoggedEdit& edit) -> base::Result<void> {
                                                 authors.push_back(authorOf(*history, edit));
                                                 return {};
                                             }));
            return authors;
        };
        using testing::ElementsAre;
        EXPECT_THAT(authorsOf({}), ElementsAre("Ann", "pack:test for Ann"));
        EXPECT_THAT(authorsOf({.player = playerCalled(*history, "Ann")}),
                    ElementsAre("Ann", "pack:test for Ann"));
        EXPECT_THAT(authorsOf({.player = playerCalled(*history, "pack:test")}),
                    ElementsAre("pack:test for Ann"));
        EXPECT_EQ(runConsoleLine(server.state(), "rollback pack:test 10"),
                  "rolling back 1 block; what changed since stays");
        ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.block(gold) == world::kAir; }));
        EXPECT_EQ(ann.block(pos), contentBlock("stone"));
        ASSERT_TRUE(stop(server.state(), "end"));
    }
    // Another run of the world has the pack's number and its storage.
    TestServer server(folder_.path());
    const rules::Rules rules(server.state().session, packWith(kScript));
    EXPECT_EQ(server.state().session.store().metadata("rules.test"), "count=i1;\n");
    TestPlayer ann(server, testIdentity("Anna"));
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.isLoaded(); }));
    EXPECT_EQ(ann.block(gold), world::kAir);
}

TEST_F(ServerRules, OperatorsReadWhyAPackIsSuspended) {
    TestServer server(folder_.path());
    const rules::Rules rules(server.state().session,
                             packWith("events.on('chat', function() error('broken') end)"));
    TestPlayer ann(server, testIdentity("Ann")), bob(server, testIdentity("Bob"));
    ASSERT_TRUE(stepUntil(server, {&ann, &bob}, [&] { return ann.isLoaded() && bob.isLoaded(); }));
    runConsoleLine(server.state(), "op Ann");
    bob.world->say("hello");
    step(server, {&ann, &bob});
    step(server, {&ann, &bob});
    take(ann);
    EXPECT_EQ(std::ranges::count(said_, "test/scripts/main.lua:1: broken"), 1);
    said_.clear();
    take(bob);
    EXPECT_EQ(std::ranges::count(said_, "test/scripts/main.lua:1: broken"), 0);
}

}  // namespace
}  // namespace terrane::net
