#include "terrane/rules/rules.h"

#include "tests/rules/rules_fixture.h"

namespace terrane::rules {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST_F(RulesTest, TheGoldRule) {
    run(R"(
        events.on("break", function(e)
            chat.say(e.player.name .. " found gold!")
            world.set(e.pos, "torch")
        end, "gold_ore")
    )");
    session_.edit({game::kNoPlayer, ground_, world::SetBlock{contentBlock("gold_ore")}, std::nullopt});
    EXPECT_EQ(set(ground_, "air"), game::EditResult::Applied);
    EXPECT_EQ(at(ground_), "torch");
    EXPECT_EQ(set({6, 5, game::kGroundHeight - 1}, "air"), game::EditResult::Applied);
    EXPECT_THAT(lines_, ElementsAre("Ann found gold!"));
    EXPECT_THAT(problems(), IsEmpty());
}

TEST_F(RulesTest, EventsTellWhatHappened) {
    run(R"(
        local function p(pos) return pos.x .. "," .. pos.y .. "," .. pos.z end
        events.on("join", function(e) chat.say("join " .. e.player.name) end)
        events.on("leave", function(e) chat.say("leave " .. e.player.name) end)
        events.on("chat", function(e) chat.say("chat " .. e.player.name .. " " .. e.text) end)
        events.on("command", function(e) chat.say("command " .. e.name .. " " .. e.args) end)
        events.on("place", function(e) chat.say("place " .. p(e.pos) .. " " .. e.block .. " " .. e.replaced) end)
        events.on("break", function(e) chat.say("break " .. p(e.pos) .. " " .. e.block) end)
        events.on("use", function(e) chat.say("use " .. e.block) end)
        events.on("build", function(e) chat.say("build " .. e.act .. " " .. p(e.low) .. " " .. p(e.high) .. " " .. e.count) end)
        events.on("claim", function(e) chat.say("claim " .. e.act .. " " .. e.name .. " " .. e.low.x .. " " .. e.high.y) end)
        events.on("tick", function(e) chat.say("tick " .. e.tick) end, 2)
        commands.add{name = "go", run = function() end}
    )");
    game::Events& events = session_.events;
    EXPECT_TRUE(game::mayChat(session_, game::kLocalPlayer, "hello"));
    events.chat.notify({game::kLocalPlayer, "hello"});
    EXPECT_TRUE(game::runChatCommand(session_, game::kLocalPlayer, "go home now"));
    set(above_, "oak_door");
    session_.edit({game::kLocalPlayer, above_, world::UseBlock{}, std::nullopt});
    set({6, 5, game::kGroundHeight - 1}, "air");
    const game::FillBox fill{{{1, 1, 70}, {2, 2, 70}}, contentBlock("sand"), 0, {}};
    session_.build({game::kLocalPlayer, fill});
    events.claim.notify({{"garden", {1, 2, 3, 4}, game::kLocalPlayer, {}}, true});
    tick(4);
    events.left.notify({game::kLocalPlayer});
    EXPECT_THAT(lines_,
                ElementsAre("join Ann", "chat Ann hello", "command go home now", "place 5,5,64 oak_door air",
                            "use oak_door", "break 6,5,63 stone", "build fill 1,1,70 2,2,70 4",
                            "claim added garden 1 4", "tick 2", "tick 4", "leave Ann"));
    EXPECT_THAT(problems(), IsEmpty());
}

TEST_F(RulesTest, BeforeEventsRefuseWithAReason) {
    run(R"(
        events.before("place", function(e) if e.pos.z > 70 then return "too high" end end)
        events.before("break", function(e) return "stone stays" end, "stone")
        events.before("use", function(e) return "locked" end)
        events.before("build", function(e) if e.count > 1 then return "one at a time" end end)
        events.before("chat", function(e) if e.text == "rude" then return "be kind" end end)
        events.before("command", function(e) return "no commands" end)
        commands.add{name = "go", run = function() chat.say("went") end}
    )");
    EXPECT_EQ(set({5, 5, 71}, "sand"), game::EditResult::Refused);
    EXPECT_EQ(set(ground_, "air"), game::EditResult::Refused);
    EXPECT_EQ(set(above_, "oak_door"), game::EditResult::Applied);
    EXPECT_EQ(session_.edit({game::kLocalPlayer, above_, world::UseBlock{}, std::nullopt}),
              game::EditResult::Refused);
    const game::FillBox fill{{{1, 1, 70}, {2, 2, 70}}, contentBlock("sand"), 0, {}};
    EXPECT_EQ(session_.build({game::kLocalPlayer, fill}).result, game::BuildOutcome::Result::Refused);
    EXPECT_FALSE(game::mayChat(session_, game::kLocalPlayer, "rude"));
    EXPECT_TRUE(game::mayChat(session_, game::kLocalPlayer, "hello"));
    EXPECT_TRUE(game::runChatCommand(session_, game::kLocalPlayer, "go"));
    EXPECT_THAT(lines_,
                ElementsAre("too high", "stone stays", "locked", "one at a time", "be kind", "no commands"));
}

TEST_F(RulesTest, PacksHearEventsInTheOrderOfLoading) {
    run({packOf("b",
                "events.on('break', function() chat.say('b') end) events.on('break', function() "
                "chat.say('B') end)"),
         packOf("a",
                "events.before('break', function() chat.say('a?') end) events.on('break', function() "
                "chat.say('a') end)")});
    set(ground_, "air");
    EXPECT_THAT(lines_, ElementsAre("a?", "b", "B", "a"));
}

TEST_F(RulesTest, AFailingPackIsSuspendedAndNothingElse) {
    run({packOf("bad",
                "events.on('break', function(e)\n  local x = e.pos.w.x\nend)\nevery(0.05, function() "
                "chat.say('bad tick') end)"
                "commands.add{name='hi', run=function() return 'hi' end}"),
         packOf("good", "events.on('break', function() chat.say('good') end)")});
    EXPECT_EQ(set(ground_, "air"), game::EditResult::Applied);
    EXPECT_EQ(set({6, 5, game::kGroundHeight - 1}, "air"), game::EditResult::Applied);
    tick(3);
    EXPECT_TRUE(game::runChatCommand(session_, game::kLocalPlayer, "hi"));
    const std::string reason = "bad/scripts/main.lua:2: attempt to index a nil value (field 'w')";
    EXPECT_THAT(problems(), ElementsAre(reason));
    EXPECT_THAT(lines_, ElementsAre(reason, "good", "good", "the rules of bad are suspended"));
}

TEST_F(RulesTest, EndedRulesHearNothing) {
    run("events.on('break', function() chat.say('heard') end) commands.add{name='hi', run=function() end}");
    rules_.reset();
    set(ground_, "air");
    EXPECT_THAT(lines_, IsEmpty());
    EXPECT_THAT(session_.chatCommands, IsEmpty());
}

TEST_F(RulesTest, ScriptsOfAPackShareOneState) {
    pack::Pack pack = packOf("test", "chat.say(name)");
    pack.files["scripts/a.lua"] = "name = 'shared'";
    pack.files["scripts/z.lua"] = "local x = nil\nx()";
    run({pack});
    EXPECT_EQ(lines_.at(0), "shared");
    EXPECT_THAT(problems(), ElementsAre("test/scripts/z.lua:2: attempt to call a nil value (local 'x')"));
}

TEST_F(RulesTest, BlocksAreReadAndChanged) {
    EXPECT_THAT(
        valuesOf(
            "world.block(pos(5, 5, 63)), world.block({x=5.9,y=5.1,z=64}), world.block(pos(5000,5,63)) == nil,"
            "world.set(pos(5,5,64), 'glass'), world.block(pos(5,5,64)), world.set(pos(5,5,64), 'glass'),"
            "select2(world.set(pos(5000,5,64), 'glass')), world.state(pos(5,5,64)),"
            "world.set(pos(6,5,64), 'oak_log', 1), world.state(pos(6,5,64)),"
            "world.setState(pos(6,5,64), 2), world.state(pos(6,5,64)), world.height(pos(5,5,0)),"
            "world.bottom(), world.top(), world.seed()",
            "function select2(a, b) return b end"),
        ElementsAre("stone", "air", "true", "true", "glass", "false", "not loaded", "0", "true", "1", "true",
                    "2", "64", "0", "256", "1"));
}

TEST_F(RulesTest, AreasAreFilledAndSearched) {
    EXPECT_THAT(
        valuesOf("world.fill(pos(7,7,65), pos(5,5,64), 'glass'), world.block(pos(6,6,65)),"
                 "at(world.find('glass', pos(6,6,70), 16)), world.find('gold_ore', pos(6,6,70), 16) == nil,"
                 "(world.fill(pos(5000,5,64), pos(5000,5,64), 'glass'))",
                 "function at(p) return p.x .. ' ' .. p.y .. ' ' .. p.z end"),
        ElementsAre("18", "glass", "6 6 65", "true", "0"));
}

TEST_F(RulesTest, RaysLightTimeAndBiomes) {
    EXPECT_THAT(
        valuesOf(
            "hit.block, hit.pos.z, hit.before.z, hit.distance, world.ray(pos(5,5,70), pos(0,0,1), 9) == nil,"
            "world.light(pos(5,5,64)).sky, world.light(pos(5000,5,64)) == nil, math.floor(world.time() * "
            "100), biome == nil",
            "world.setTime(0.25) hit = world.ray(pos(5.5,5.5,70), pos(0,0,-1), 20) biome = "
            "world.biome(pos(0,0,0))"),
        ElementsAre("stone", "63", "64", "6.0", "true", "15", "true", "25", "true"));
    EXPECT_NEAR(session_.clock.timeDay, 0.25, 0.001);
}

TEST_F(RulesTest, PlayersAreKnown) {
    EXPECT_THAT(
        valuesOf("ann.name, ann.id, ann.pos.x, ann.yaw, ann.pitch, ann.role, ann.isOnline, #players.all(),"
                 "players.all()[1] == ann, players.find('Bob') == nil, type(ann)",
                 "events.on('tick', function() ann = players.find('Ann') end)"),
        ElementsAre("Ann", "1", "5.5", "0.0", "0.0", "player", "true", "1", "true", "true", "Player"));
}

TEST_F(RulesTest, PlayersHaveItems) {
    session_.mode = game::Mode::Survival;
    EXPECT_THAT(
        valuesOf(
            "p.mode, tostring(p.hand), p:give('torch', 5), p.hand, p:give('iron_pick'), p:count('torch'), "
            "p:take('torch', 9), p:count('torch'), p:count('iron_pick')",
            "p = nil events.on('join', function(e) p = e.player end)"),
        testing::ElementsAre("survival", "nil", "5", "torch", "1", "5", "5", "0", "1"));
    for (const char* wrong : {"p:give('torhc')", "p:give('torch', -1)", "p:give()", "p.give('torch')"}) {
        run("events.on('join', function(e) local p = e.player " + std::string(wrong) + " end)");
        EXPECT_THAT(problems(), testing::SizeIs(1)) << wrong;
    }
    run("events.on('join', function(e) e.player:give('torhc') end)");
    EXPECT_THAT(problems(), testing::ElementsAre(
                                "test/scripts/main.lua:1: give: there is no item \"torhc\"; did you mean "
                                "torch?"));
    run("events.before('place', function(e) e.player:give('torch') end)");
    (void)set(above_, "stone");
    session_.mode = game::Mode::Creative;
    (void)set(above_, "stone");
    EXPECT_THAT(problems(), testing::ElementsAre(testing::HasSubstr("only decides")));
}

TEST_F(RulesTest, ChestsHaveItems) {
    session_.edit({game::kNoPlayer, above_, world::SetBlock{contentBlock("chest")}, std::nullopt});
    EXPECT_THAT(
        valuesOf("tostring(world.items(ground)), #world.items(chest), world.putItems(chest, 'coal', 120), "
                 "world.takeItems(chest, 'coal', 1), world.items(chest)[2].item, "
                 "world.items(chest)[2].count, world.putItems(ground, 'coal'), "
                 "world.putItems(chest, 'iron_pick', 40)",
                 "chest = pos(5, 5, 64) ground = pos(5, 5, 63)"),
        testing::ElementsAre("nil", "0", "120", "1", "coal", "20", "0", "25"));
}

TEST_F(RulesTest, ItemsThatPlayersUseAndMakeAreTold) {
    run("events.on('itemused', function(e) chat.say(e.player.name .. ' used ' .. e.item) end)\n"
        "events.on('crafted', function(e) chat.say('made ' .. e.count .. ' ' .. e.item) end)");
    session_.give(game::kLocalPlayer, {"bread", 1});
    session_.act(game::kLocalPlayer, game::UseItem{});
    session_.give(game::kLocalPlayer, {"birch_log", 1});
    session_.act(game::kLocalPlayer, game::MoveStack{{{}, 0}, {{}, 40}, 1});
    session_.act(game::kLocalPlayer, game::CraftItems{});
    EXPECT_THAT(lines_, testing::ElementsAre("Ann used bread", "made 4 birch_planks"));
    EXPECT_THAT(problems(), testing::IsEmpty());
}

TEST_F(RulesTest, LinesGoToOneOrToAll) {
    std::vector<game::PlayerId> to;
    const game::Subscription hearing =
        session_.events.said.add([&](const game::Said& line) { to.push_back(line.to); });
    run("events.on('join', function(e) e.player:say('one') chat.say('all') e.player:say(3) end)");
    EXPECT_THAT(to, ElementsAre(game::kLocalPlayer, game::kNoPlayer, game::kLocalPlayer));
    EXPECT_THAT(lines_, ElementsAre("one", "all", "3"));
}

TEST_F(RulesTest, CommandsRunWithArguments) {
    run("commands.add{name='home', args='[set]', help='go home', run=function(player, args)"
        " return player.name .. ' ' .. args end}");
    EXPECT_TRUE(game::runChatCommand(session_, game::kLocalPlayer, "home set 1"));
    EXPECT_THAT(lines_, ElementsAre("Ann set 1"));
    EXPECT_EQ(game::chatHelp(session_.chatCommands), "/home [set]: go home");
}

TEST_F(RulesTest, TimersRunOnceOrRepeat) {
    run(R"(
        after(0.1, function() chat.say("once") end)
        local id = every(0.1, function() chat.say("again") end)
        after(0.35, function() cancel(id) end)
        cancel(after(0.05, function() chat.say("never") end))
    )");
    tick(12);
    EXPECT_THAT(lines_, ElementsAre("once", "again", "again", "again"));
}

TEST_F(RulesTest, ChanceIsOfTheWorldAndTheTick) {
    const std::string script = "every(0.05, function() chat.say(random(1, 1000) .. ' ' .. random()) end)";
    run(script);
    session_.clock.timeDay = 0.5;
    tick(2);
    const std::vector<std::string> first = std::exchange(lines_, {});
    run(script);
    session_.clock.timeDay = 0.5;
    tick(2);
    EXPECT_EQ(lines_, first);
    EXPECT_NE(first[0], first[1]);
    EXPECT_THAT(valuesOf("random(5, 5), random() < 1, random(-2, -1) < 0"), ElementsAre("5", "true", "true"));
}

TEST_F(RulesTest, RandomTicksAreOfOneKindOfBlock) {
    session_.edit({game::kNoPlayer, above_, world::SetBlock{contentBlock("gold_ore")}, std::nullopt});
    run("n = 0 events.on('random', function(e) n = n + (e.block == 'stone' and 1 or 1000000) end, 'stone')"
        "commands.add{name='n', run=function() return tostring(n) end}");
    tick(10);
    EXPECT_TRUE(game::runChatCommand(session_, game::kLocalPlayer, "n"));
    // 49 chunks of 4 sections of stone, 3 picks each, in 10 ticks.
    EXPECT_GT(std::stoi(lines_.at(0)), 5000);
    EXPECT_LE(std::stoi(lines_.at(0)), 5880);
}

TEST_F(RulesTest, WhatScriptsChangeForPlayersKeepsToClaims) {
    ASSERT_TRUE(session_.permissions.claims.add({"garden", {5, 5, 5, 5}, 9, {}}));
    std::vector<game::Author> authors;
    const game::Subscription hearing = session_.events.changed.add(
        [&](const game::BlocksChanged& event) { authors.push_back(event.author); });
    run(R"(
        events.on("place", function(e)
            local done, why = world.set(pos(5, 5, 64), "gold_ore")
            chat.say(tostring(done) .. " " .. tostring(why))
            after(0.05, function() world.set(pos(5, 5, 65), "gold_ore") world.set(pos(8, 8, 64), "gold_ore") end)
        end)
        every(0.2, function() world.set(pos(5, 5, 66), "gold_ore") end)
    )");
    set({7, 7, 64}, "glass");
    tick(4);
    EXPECT_EQ(at({5, 5, 64}), "air");
    EXPECT_EQ(at({5, 5, 65}), "air");
    EXPECT_EQ(at({8, 8, 64}), "gold_ore");
    EXPECT_EQ(at({5, 5, 66}), "gold_ore") << "it acts for nobody";
    EXPECT_THAT(lines_, ElementsAre("false claimed"));
    EXPECT_THAT(authors, ElementsAre(game::Author{game::kLocalPlayer, game::kNoPack},
                                     game::Author{game::kLocalPlayer, 1}, game::Author{game::kNoPlayer, 1}));
    EXPECT_THAT(session_.packs, ElementsAre("test"));
}

TEST_F(RulesTest, StorageKeepsValuesWithTheWorld) {
    run(R"(
        storage.set("score", 3)
        storage.set("table", {1, 2.5, "x", {deep = true}, [-1] = false})
        storage.set("gone", "soon")
        storage.set("gone", nil)
        chat.say(tostring(storage.get("gone")) .. tostring(storage.get("never")))
    )");
    EXPECT_EQ(session_.store().metadata("rules.test"),
              "score=i3;\ntable={i-1;fi1;i1;i2;d2.5;i3;s1:x;i4;{s4:deep;t}}\n");
    EXPECT_THAT(
        valuesOf("storage.get('score'), t[1], t[2], t[3], t[4].deep, t[-1], #t", "t = storage.get('table')"),
        ElementsAre("3", "1", "2.5", "x", "true", "false", "4"));
    run({packOf("other", "chat.say(tostring(storage.get('score')))")});
    EXPECT_EQ(lines_.back(), "nil");
}

TEST_F(RulesTest, StorageIsBounded) {
    run(R"(
        local text = string.rep("x", 60000)
        n = 0
        every(0.05, function() n = n + 1 storage.set("k" .. n, text) end)
    )");
    tick(30);
    ASSERT_EQ(problems().size(), 1u);
    EXPECT_EQ(problems()[0], "test/scripts/main.lua:4: set: the storage of a pack takes at most 1024 KiB");
    const std::string stored = session_.store().metadata("rules.test").value_or("");
    EXPECT_LE(stored.size(), std::size_t{1} << 20);
    EXPECT_NE(stored.find("\nk17="), std::string::npos);
    EXPECT_EQ(stored.find("\nk18="), std::string::npos);
    run("storage.set('k1', nil) storage.set('new', string.rep('x', 50000)) chat.say('room')");
    EXPECT_EQ(lines_.back(), "room");
}

TEST(RuleScripts, AreCheckedInAWorldOfTheirOwn) {
    const auto check = [](const std::string& script) {
        auto content = pack::loadContent({packOf("test", script)});
        EXPECT_TRUE(content);
        const auto checked = checkScripts(*content);
        return checked ? std::string("good") : checked.error().message;
    };
    EXPECT_EQ(check("events.on('break', function() world.set(pos(0, 0, 0), 'gold_ore') end)"), "good");
    EXPECT_EQ(check("events.on('plase', function() end)"),
              "test/scripts/main.lua:1: on: there is no event \"plase\"; did you mean place?");
    EXPECT_EQ(check("x = = 1"), "test/scripts/main.lua:1: unexpected symbol near '='");
    EXPECT_EQ(check("\nworld.set(pos(0, 0, 0), 'gold_oer')"),
              "test/scripts/main.lua:2: unknown block \"gold_oer\"; did you mean gold_ore?");
}

}  // namespace
}  // namespace terrane::rules
