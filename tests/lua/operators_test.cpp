// Every operator and every method, applied to every kind of value a script can hold, ends well or with a
// line.
#include "tests/lua/lua_fixture.h"

namespace terrane::lua {
namespace {

constexpr const char* kValues[] = {"nil",
                                   "true",
                                   "3",
                                   "2.5",
                                   "(0/0)",
                                   "\"stone\"",
                                   "{}",
                                   "print",
                                   "p.x",
                                   "p:random2D(\"r\")",
                                   "p.x:lt(0)",
                                   "p:block(\"stone\")",
                                   "vec2(1, 2)",
                                   "vec3(1, 2, 3)",
                                   "ivec2(p.x, 2)",
                                   "p:var(1)",
                                   "field",
                                   "map",
                                   "p",
                                   "g",
                                   "trees",
                                   "trees.oak",
                                   "earlier",
                                   "earlierPass",
                                   "earlierVariable"};

constexpr const char* kOperators[] = {
    "-A",          "~A",      "#A",      "not A",        "A + B",          "A - B",
    "A * B",       "A / B",   "A // B",  "A % B",        "A ^ B",          "A & B",
    "A | B",       "A ~ B",   "A << B",  "A >> B",       "A .. B",         "A < B",
    "A <= B",      "A > B",   "A >= B",  "A == B",       "A ~= B",         "A.x",
    "A[B]",        "A.value", "A(B)",    "A:lt(B)",      "A:le(B)",        "A:gt(B)",
    "A:ge(B)",     "A:eq(B)", "A:ne(B)", "p.x.lt(A, B)", "p.set(A, B, B)", "g.field(A, B, B)",
    "g.tint(A, B)"};

constexpr const char* kMethods[] = {"read",
                                    "readAt",
                                    "slope",
                                    "lowestBeside",
                                    "readBetween",
                                    "set",
                                    "setAt",
                                    "block",
                                    "blockHere",
                                    "blockInColumn",
                                    "blockAt",
                                    "setBlock",
                                    "stamp",
                                    "var",
                                    "if_",
                                    "while_",
                                    "perlin2D",
                                    "perlin3D",
                                    "grain",
                                    "grain2D",
                                    "stripes2D",
                                    "voronoi2D",
                                    "voronoi3D",
                                    "drainage",
                                    "valleys",
                                    "random2D",
                                    "random3D",
                                    "randomBool2D",
                                    "scatter",
                                    "erode",
                                    "perlin2DGradient",
                                    "perlin3DGradient",
                                    "perlin2DWithGrain",
                                    "simplex2D",
                                    "simplex3D",
                                    "randomBool3D"};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
    return text;
}

// Runs `text` in a 3D pass where `a` and `b` are the two values.
void expectOneLine(const std::string& text, const char* a, const char* b) {
    constexpr const char* kPreamble = R"(
        local earlier, earlierPass, earlierVariable
        local field = g:field("field", "int")
        local map = g:drainage("map", {}, function(p) return 100 end, function(p) return 1 end)
        local trees = {oak = {first = 0, count = 4}}
        g:pass2D("first", function(p)
            earlier, earlierPass, earlierVariable = p.x, p, p:var(2)
            p:set(field, p.y)
        end)
        g:pass3D("second", function(p)
            local a, b = )";
    const std::string script = kPreamble + std::string(a) + ", " + b + "\nlocal result = " + text + " end)";
    const std::string mistake = mistakeOf(script);
    if (mistake.empty()) return;
    EXPECT_TRUE(mistake.starts_with("test.lua:")) << script << "\n" << mistake;
    // The values are all there: the mistake is one of the use.
    const bool isOfUse = mistake.starts_with("test.lua:12: ") || mistake.starts_with("test.lua:10: pass ") ||
                         mistake.starts_with("test.lua: generator ");
    EXPECT_TRUE(isOfUse) << script << "\n" << mistake;
    EXPECT_EQ(mistake.find('\n'), std::string::npos) << script;
    EXPECT_EQ(mistake.find("assert"), std::string::npos) << mistake;
}

TEST(Operators, TakeEveryKindOfValue) {
    for (const char* text : kOperators) {
        const std::string applied = replaced(replaced(text, "A", "a"), "B", "b");
        for (const char* value : kValues) {
            expectOneLine(applied, value, value);
            if (applied.find('b') == std::string::npos) continue;
            for (const char* other : {"p.x", "p:random2D(\"r\")", "map"}) {
                expectOneLine(applied, value, other);
                expectOneLine(applied, other, value);
            }
        }
    }
}

TEST(Operators, MethodsTakeEveryKindOfValue) {
    for (const char* method : kMethods) {
        for (const char* a : kValues) {
            const std::string call = "p:" + std::string(method);
            expectOneLine(call + "(a, a, a, a)", a, "nil");
            expectOneLine(call + "(\"n\", 16, a, a)", a, "nil");
            expectOneLine(call + "(a)", a, "nil");
        }
    }
}

TEST(Operators, NegationNamesTheValue) {
    EXPECT_NE(mistakeOf("local f = g:field(\"f\", \"int\") local x = -f").find("this is a field"),
              std::string::npos);
    EXPECT_NE(mistakeOf("local m = g:drainage(\"d\", {}, function() return 1 end) local x = -m")
                  .find("expected an expression, got Drainage"),
              std::string::npos);
}

}  // namespace
}  // namespace terrane::lua
