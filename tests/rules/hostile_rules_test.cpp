// Malicious rules are suspended with one line, and everything else goes on.
#include <cctype>

#include "tests/rules/rules_fixture.h"

namespace terrane::rules {
namespace {

struct Hostile {
    const char* name;
    const char* script;  // on line 1
    const char* reason;  // a part of it
};

// Each fails when it is loaded, when Ann joins, when she breaks a block, in a tick or in a command.
constexpr Hostile kHostile[] = {
    {"endless loop", "while true do end", "runs too long"},
    {"endless loop in an event", "events.on('break', function() while true do end end)", "runs too long"},
    {"endless loop before an event", "events.before('break', function() repeat until false end)",
     "runs too long"},
    {"endless loop in a timer", "every(0.05, function() while true do end end)", "runs too long"},
    {"endless loop in a command", "commands.add{name='bad', run=function() while true do end end}",
     "runs too long"},
    {"endless goto", "::a:: goto a", "runs too long"},
    {"endless recursion", "local function f() return f() + 1 end f()", "runs too long"},
    {"endless tail calls", "local function f() return f() end f()", "runs too long"},
    {"memory in tables", "local t = {} while true do t[#t+1] = {} end", ""},
    {"memory in one table", "t = {} for k = 1, 1e9 do t[k] = k end", ""},
    {"memory over ticks", "t = {} every(0.05, function() for k = 1, 20000 do t[#t+1] = {} end end)",
     "memory"},
    {"giant string", "s = string.rep('x', 1e9)", "the text would be longer"},
    {"doubled string", "s = 'x' while true do s = s .. s end", ""},
    {"kept strings", "t = {} for k = 1, 1e6 do t[k] = string.rep('x', 60000) .. k end", ""},
    {"no patterns", "('x'):gsub('.', '%1')", "gsub"},
    {"no matches", "string.match(string.rep('a', 60000), '.-.-.-b')", "match"},
    {"no metatables", "setmetatable({}, {__gc = function() end})", "setmetatable"},
    {"no string metatable", "getmetatable('').__index = nil", "getmetatable"},
    {"no coroutines", "coroutine.wrap(function() end)()", "coroutine"},
    {"no loading", "load('return 1')()", "load"},
    {"no files", "io.open('/etc/passwd')", "io"},
    {"no clock", "os.time()", "os"},
    {"no pcall", "pcall(function() while true do end end)", "pcall"},
    {"no raw access", "rawset(_G, 'x', 1)", "rawset"},
    {"error in a message", "error(setmetatable)", "message is not a text"},
    {"error of an error", "error({})", "message is not a text"},
    {"control characters", "error('a\\n\\27[31mb\\1c')", "a "},
    {"handlers without end", "while true do events.on('break', function() end) end",
     "more than 1000 handlers"},
    {"handlers in handlers",
     "function f() events.on('tick', f) events.on('tick', f) end events.on('tick', f)", ""},
    {"timers without end", "while true do after(1e6, function() end) end", ""},
    {"timers that make two", "function f() after(0, f) after(0, f) end f()", ""},
    {"commands without end", "for k = 1, 1e6 do commands.add{name='c' .. k, run=function() end} end",
     "more than 100"},
    {"commands of a bad name", "commands.add{name='a b', run=function() end}", "name"},
    {"chat without end", "every(0.05, function() while true do chat.say('x') end end)", "lines in a tick"},
    {"storm of changes",
     "every(0.05, function() for k = 1, 1e9 do world.set(pos(1,1,70), k % 2 == 0 and 'stone' or 'sand') end "
     "end)",
     "runs too long"},
    {"storm of fills",
     "every(0.05, function() while true do world.fill(pos(0,0,64), pos(31,31,90), 'sand') "
     "world.fill(pos(0,0,64), pos(31,31,90), 'air') end end)",
     "runs too long"},
    {"huge fill", "world.fill(pos(-1e9,-1e9,0), pos(1e9,1e9,255), 'air')", "at most 32768"},
    {"huge search", "world.find('stone', pos(0,0,0), 1e6)", "is not in"},
    {"many searches", "while true do world.find('gold_ore', pos(0,0,60), 16) end", "runs too long"},
    {"long ray", "world.ray(pos(0,0,0), pos(1,0,0), 1e9)", "is not in"},
    {"a place that is none", "world.set({x=0/0, y=1, z=1}, 'sand')", "expected a position"},
    {"a place far away", "world.block({x=1e300, y=-1e300, z=1e300}) error('done')", "done"},
    {"changes before an event", "events.before('break', function(e) world.set(e.pos, 'sand') end)",
     "only decides"},
    {"storage before an event", "events.before('break', function(e) storage.set('x', 1) end)",
     "only decides"},
    {"stored function", "storage.set('x', print)", "function cannot be stored"},
    {"stored circle", "t = {} t[1] = t storage.set('x', t)", "deep"},
    {"stored branches", "t = {} for k = 1, 15 do t = {t, t, t, t, t, t, t, t} end storage.set('x', t)", ""},
    {"stored text", "storage.set('x', string.rep('\\0', 60000))", "64 KiB"},
    {"stored nan", "storage.set('x', 0/0)", "cannot be stored"},
    {"long key", "storage.set(string.rep('k', 1000), 1)", "a key has"},
    {"damaged storage", "storage.get('damaged')", "damaged"},
    {"changed player", "events.on('join', function(e) e.player.name = 'Bob' end)", "cannot be changed"},
    {"no such member", "events.on('join', function(e) e.player:kick() end)", "kick"},
    {"player without a colon", "events.on('join', function(e) e.player.say('x') end)", "expected a player"},
    {"sort that contradicts",
     "t = {} for k = 1, 2e4 do t[k] = k end while true do table.sort(t, function() return true end) end",
     "runs too long"},
};

class HostileRules : public RulesTest {};

TEST_F(HostileRules, AreSuspendedWithOneLine) {
    EXPECT_GE(std::size(kHostile), 50u);
    session_.store().setMetadata("rules.bad", "damaged=s9:x\n");
    for (const Hostile& hostile : kHostile) {
        SCOPED_TRACE(hostile.name);
        run({packOf("bad", hostile.script),
             packOf("good", "events.on('break', function() chat.say('good') end)")});
        EXPECT_EQ(set({8, 8, game::kGroundHeight - 1}, "air"), game::EditResult::Applied);
        EXPECT_EQ(set({8, 8, game::kGroundHeight - 1}, "stone"), game::EditResult::Applied);
        game::runChatCommand(session_, game::kLocalPlayer, "bad");
        tick(40);
        EXPECT_EQ(set({8, 8, game::kGroundHeight - 1}, "air"), game::EditResult::Applied);
        EXPECT_EQ(set({8, 8, game::kGroundHeight - 1}, "stone"), game::EditResult::Applied);
        ASSERT_EQ(problems().size(), 1u);
        const std::string& problem = problems()[0];
        EXPECT_TRUE(problem.starts_with("bad/scripts/main.lua:1: ")) << problem;
        EXPECT_NE(problem.find(hostile.reason), std::string::npos) << problem;
        EXPECT_LT(problem.size(), 400u);
        for (const char byte : problem) EXPECT_TRUE(static_cast<unsigned char>(byte) >= ' ') << problem;
        EXPECT_EQ(std::ranges::count(lines_, "good"), 2);
        EXPECT_EQ(std::ranges::count(lines_, problem), 1) << "told once to who is at the screen";
        lines_.clear();
    }
}

// A script that changes blocks in a handler of changes causes no event: only players do.
TEST_F(HostileRules, ChangesOfScriptsAreNoEvents) {
    run("n = 0 events.on('place', function(e) n = n + 1 world.set(e.pos, n % 2 == 0 and 'sand' or 'glass') "
        "end)");
    set(above_, "stone");
    EXPECT_EQ(at(above_), "glass");
    EXPECT_TRUE(problems().empty());
}

// Steps and not the clock end a script, so it ends at the same place each time.
TEST_F(HostileRules, EndAtTheSameBlock) {
    const std::string script =
        "every(0.05, function() for x = 0, 1e6 do world.set(pos(x % 32, x // 32 % 32, 70), 'glass') end end)";
    const auto count = [&] {
        int blocks = 0;
        for (int k = 0; k < 1024; ++k) blocks += at({k % 32, k / 32, 70}) == "glass" ? 1 : 0;
        return blocks;
    };
    run(script);
    tick(2);
    const int first = count();
    EXPECT_GT(first, 100);
    session_.build({game::kNoPlayer, game::FillBox{{{0, 0, 70}, {31, 31, 70}}, world::kAir, 0, {}}});
    run(script);
    tick(2);
    EXPECT_EQ(count(), first);
}

}  // namespace
}  // namespace terrane::rules
