// Mistakes of authors come back with the line and say what to do.
#include "tests/lua/lua_fixture.h"

namespace terrane::lua {
namespace {

struct Mistake {
    const char *text, *reason;
};

// In the second line of a 2D pass.
constexpr Mistake kMistakes[] = {
    {"local a = p.x + p:random2D(\"r\")", "Int and Float do not match: write float(…)"},
    {"local a = p.x < 3", "< and > do not compare expressions: write a:lt(b) or a:gt(b)"},
    {"local a = p.x >= p.y", "<= and >= do not compare expressions: write a:le(b) or a:ge(b)"},
    {"local a = p.x == p.y", "== and ~= do not compare expressions: write a:eq(b) or a:ne(b)"},
    {"local a = p.x / 2", "Int has no operator /: write // for whole numbers, or float(a) / b"},
    {"local a = p.x + 1.5", "expected Int, got number 1.5"},
    {"local a = p.x + 5000000000", "5000000000 is not in -2147483648…2147483647"},
    {"local a = p.x .. \"m\"", ".. joins texts; this is Int"},
    {"local a = #p.x", "# counts lists; the length of a vector is length(v); this is Int"},
    {"local a = p.x.y", "Int has no \"y\""},
    {"local a = p:perlin2d(\"n\", 8, {1})", "a pass has no \"perlin2d\"; did you mean perlin2D?"},
    {"local a = p.perlin2D(\"n\", 8, {1})",
     "perlin2D: its object is missing: write a colon, as in p:perlin2D(…)"},
    {"local a = p.x.z", "Int has no \"z\""},
    {"local a = p:block(\"ston\")", "unknown block \"ston\"; did you mean stone?"},
    {"local a = select(p.x:lt(0), \"stone\", 1)", "expected Block, got number 1"},
    {"local a = select(p.x, 1, 2)", "select: argument 1: expected Bool, got Int"},
    {"local a = select(nil, 1, 2)", "select: argument 1: expected Bool, got nil"},
    {"local a = sqrt(p.x)", "sqrt: argument 1: expected Float, got Int: write float(…)"},
    {"local a = floorDivide(p:random2D(\"r\"), 2)",
     "floorDivide: argument 1: expected Int, got Float: write int(…)"},
    {"local a = p:perlin2D(\"n\", 8, {})", "perlin2D: argument 3: takes 1 to 12 octave weights"},
    {"local a = p:perlin2D(\"n\", 0, {1})", "perlin2D: argument 2: 0 is not in 1…65536"},
    {"local a = p:perlin2D(\"n\", 8, {0/0})", "perlin2D: number "},
    {"local a = p:perlin2D(\"n\", 8, {1}) + p:perlin2D(\"n\", 9, {1})",
     "noise \"n\" is used twice with different parameters"},
    {"local a = p:voronoi2D(\"v\", 8, 9)", "9 points per cell, expected 1 to 4"},
    {"local a = p.z", "pass \"land\": z: only in 3D passes"},
    {"p:setBlock(\"stone\")", "pass \"land\": setBlock: only in 3D passes"},
    {"p:read(g:field(\"f\", \"int\"))", "field: not inside of a pass"},
    {"g:trees()", "trees: not inside of a pass"},
    {"g:pass2D(\"x\", function() end)", "pass2D: not inside of a pass"},
    {"local v = p:var(1) v.value = 1.5", "expected Int, got number 1.5"},
    {"local v = p:var(1) local w = v + 1", "this is a variable: its value is v.value"},
    {"local v = p:var(1) v.x = 1", "a variable has only its value: v.value"},
    {"local v = p:var(vec2(1, 2))", "var: a variable cannot hold a Vec2: make one for each component"},
    {"p.x.value = 1", "Int cannot be changed"},
    {"p:if_(p.x, function() end)", "if_: argument 1: expected Bool, got Int"},
    {"p:if_(p.x:lt(0), 3)", "if_: argument 2: expected a function, got number 3"},
    {"p:while_(function() return 1 end, function() end)",
     "while_: its first function must return a Bool, got number 1"},
    {"p:erode(\"e\", vec2(0, 0), 1, {octave = 3})",
     "erode: there is no option octave; did you mean octaves?"},
    {"p:erode(\"e\", vec2(0, 0), 1, {octaves = 9})", "erode: octaves 9 is not in 1…8"},
    {"p:scatter(\"s\", 2000, 3)", "scatter: argument 2: 2000 is not in 1…1024"},
    {"multiSelect({{p.x:lt(0), 1}, 5}, 2)", "multiSelect: case 2 is not {condition, value}"},
    {"multiSelect({{p.x:lt(0), 1}})",
     "multiSelect: argument 2: expected the value where no case holds, got nil"},
    {"error(\"mine\")", "mine"},
    {"assert(false, \"mine too\")", "mine too"},
    {"string.format(\"%d\")", "bad argument #2 to 'format' (no value)"},
    {"local t = {} t[{}] = 1 for k in pairs(t) do end", "pairs: keys that are table have no order"},
    {"nothing()", "attempt to call a nil value (global 'nothing')"},
    {"local a = nothing.x", "attempt to index a nil value (global 'nothing')"},
    {"p:drainage(3)", "drainage: argument 1: expected Drainage, got number 3"},
    {"p:valleys(3)", "valleys: argument 1: expected Drainage, got number 3"},
    {"g:drainage(\"d\", {}, function(p) return 1 end)", "drainage: not inside of a pass"},
};

TEST(ScriptErrors, NameTheLineAndTheReason) {
    for (const Mistake& mistake : kMistakes) {
        const std::string message = mistakeInPass(mistake.text);
        EXPECT_TRUE(message.starts_with("test.lua:2: ")) << mistake.text << "\n" << message;
        EXPECT_NE(message.find(mistake.reason), std::string::npos) << mistake.text << "\n" << message;
    }
}

// Of a drainage map and its valleys.
TEST(ScriptErrors, OfGradients) {
    const auto mistake = [](const std::string& functions, const std::string& pass) {
        return mistakeOf("local map = g:drainage(\"d\", {}, " + functions + ")\n" + "g:" + pass +
                         "(\"p\", function(p) local v = p:valleys(map) end)\n" +
                         "g:pass3D(\"ground\", function(p) p:setBlock(\"air\") end)");
    };
    const std::string height = "function(p) return 100 end";
    EXPECT_EQ(mistake(height + ", function(p) return 0.2 end", "pass2D"), "");
    EXPECT_EQ(mistake(height, "pass2D"),
              "test.lua:2: pass \"p\": drainage \"d\": has no gradients, so no valleys");
    EXPECT_EQ(mistake(height + ", nil", "pass2D"), mistake(height, "pass2D")) << "no function";
    EXPECT_EQ(mistake(height + ", function(p) return 0.2 end", "pass3D"),
              "test.lua:2: pass \"p\": drainage \"d\": only in 2D passes");
    EXPECT_EQ(mistake(height + ", 0.2", "pass2D"),
              "test.lua:1: drainage: argument 4: expected a function, got number 0.2");
    EXPECT_EQ(mistake(height + ", function(p) return p.x end", "pass2D"),
              "test.lua:1: drainage: its gradient function must return a Float, got Int");
    EXPECT_EQ(mistake(height + ", function(p) return \"steep\" end", "pass2D"),
              "test.lua:1: drainage: its gradient function must return a Float, got a string");
    EXPECT_EQ(mistake(height + ", function(p) end", "pass2D"),
              "test.lua:1: drainage: its gradient function must return a Float, got nil");
    EXPECT_EQ(mistake("function(p) return p.x end", "pass2D"),
              "test.lua:1: drainage: its height function must return a Float, got Int");
}

TEST(ScriptErrors, OfTheWholeGeneratorNameTheFile) {
    EXPECT_EQ(mistakeOf(""), "test.lua: generator \"test\": the last pass must be a 3D pass");
    EXPECT_EQ(mistakeOf("x = = 1"), "test.lua:1: unexpected symbol near '='");
    EXPECT_EQ(mistakeOf("g:trees {'oak', 'elm'}"), "test.lua:1: trees: there is no kind \"elm\"");
    EXPECT_EQ(mistakeOf("g:trees {'oak', 3}"), "test.lua:1: trees: name 2 is not a string");
    EXPECT_EQ(mistakeOf("g:trees('oak')"), "test.lua:1: trees: argument 1: expected a table, got a string");
}

TEST(ScriptErrors, AreFoundWhereAPassEnds) {
    EXPECT_EQ(
        mistakeOf(R"(
        g:pass3D("ground", function(p)
            local inside
            local v = p:var(p.x)
            p:while_(function() return v.value:gt(0) end, function()
                inside = v.value + 1
                v.value = v.value - 1
            end)
            p:setBlock(select(inside:gt(0), "stone", "air"))
        end))"),
        "test.lua:2: pass \"ground\": a value made inside while_ is used after it: carry it out in a Var");
}

TEST(ScriptErrors, ValuesOfOtherPassesAreRefused) {
    const std::string use = R"(
        local kept
        g:pass2D("first", function(p) kept = KEPT end)
        g:pass3D("second", function(p) USE end))";
    const auto mistake = [&](std::string kept, std::string used) {
        std::string text = use;
        text.replace(text.find("KEPT"), 4, kept);
        text.replace(text.find("USE"), 3, used);
        return mistakeOf(text);
    };
    EXPECT_EQ(mistake("p.x", "local y = kept + 1"),
              "test.lua:4: this Int belongs to another pass: pass it on in a field");
    EXPECT_EQ(mistake("p.x", "p:setBlock(select(kept:lt(p.x), \"stone\", \"air\"))"),
              "test.lua:4: this Int belongs to another pass: pass it on in a field");
    EXPECT_EQ(mistake("p:var(1)", "kept.value = 2"), "test.lua:4: this variable belongs to another pass");
    EXPECT_EQ(mistake("p", "kept:setBlock(\"stone\")"),
              "test.lua:4: setBlock: this pass is not the one that is being written");
    EXPECT_EQ(mistake("p", "local x = kept.x"),
              "test.lua:4: p.x: this pass is not the one that is being written");
    // Literals are good anywhere.
    EXPECT_EQ(mistake("p:block(\"stone\")", "p:setBlock(kept)"), "");
    EXPECT_EQ(mistake("floor(2.5)", "p:setBlock(select(float(p.z):lt(kept), \"stone\", \"air\"))"), "");
}

TEST(ScriptErrors, LongFileNamesStayWhole) {
    const std::string file =
        "a/long/path/to/some/folder/in/which/there/are/many/generators/of/all/kinds/isles.lua";
    const auto graph = recordScript({"\n\nlocal x = nil + 1", file}, {"x", ""}, contentBlocks());
    ASSERT_FALSE(graph);
    EXPECT_EQ(graph.error().message, file + ":3: attempt to perform arithmetic on a nil value");
}

}  // namespace
}  // namespace terrane::lua
