// Scripts and the heights of worlds.
#include <gtest/gtest.h>

#include <string>

#include "terrane/lua/graph_limits_internal.h"
#include "tests/lua/same_graph.h"

namespace terrane::lua {
namespace {

using world::Heights;

constexpr std::string_view kAllStone = R"(g:pass3D("a", function(p) p:setBlock("stone") end))";

TEST(ScriptHeights, AreThoseThatItDeclares) {
    const std::string text = "g:heights(-64, 320)\n" + std::string(kAllStone);
    const auto graph = recorded(text);
    ASSERT_TRUE(graph) << graph.error().message;
    EXPECT_EQ(graph->heights, (Heights{-64, 320}));
    EXPECT_EQ(recorded(kAllStone)->heights, Heights());
}

TEST(ScriptHeights, OfTheWorldComeFirst) {
    const std::string text = R"(
        g:heights(-64, 320)
        g:pass3D("floor", function(p)
            p:setBlock(select(p.z:eq(g.bottom) | p.z:eq(g.top - 1), "stone", "air"))
        end))";
    for (const Heights heights : gen::kSomeHeights) {
        const auto graph = recorded(text, 0, heights);
        ASSERT_TRUE(graph) << graph.error().message;
        EXPECT_EQ(graph->heights, heights);
        const auto blocks = chunkOf(*graph, {3, -4});
        EXPECT_EQ(blocks.front(), contentBlocks().find("stone")->id);
        EXPECT_EQ(blocks[256], world::kAir);
        EXPECT_EQ(blocks.back(), contentBlocks().find("stone")->id);
    }
}

// A script records what C++ does.
TEST(ScriptHeights, MakeTheGraphOfCpp) {
    GeneratorBuilder builder("test", contentBlocks());
    builder.declareHeights({-512, 512});
    builder.pass3D("a", [&](Pass& p) {
        p.setBlock(select(p.z() < p.heights().bottom + 5, p.block("stone"), p.block("air")));
    });
    const auto graph = builder.finish();
    ASSERT_TRUE(graph) << graph.error().message;
    const auto script = recorded(R"(
        g:heights(-512, 512)
        g:pass3D("a", function(p) p:setBlock(select(p.z:lt(g.bottom + 5), "stone", "air")) end))");
    ASSERT_TRUE(script) << script.error().message;
    EXPECT_EQ(gen::graphHash(*graph), gen::graphHash(*script));
}

TEST(ScriptHeights, MistakesAreNamed) {
    const auto mistake = [](const std::string& text) {
        return mistakeOf(text + "\n" + std::string(kAllStone));
    };
    const std::string rule = world::checkHeights({0, 100}).error().message;
    EXPECT_EQ(mistake("g:heights(0, 100)"), "test.lua:1: " + rule);
    EXPECT_EQ(mistake("g:heights(64, 64)"), "test.lua:1: " + world::checkHeights({64, 64}).error().message);
    EXPECT_EQ(mistake("g:heights(0, 64) g:heights(0, 64)"), "test.lua:1: heights are declared twice");
    EXPECT_EQ(mistake(std::string(kAllStone) + "\ng:heights(0, 64)"),
              "test.lua:2: heights are declared after a pass");
    EXPECT_EQ(mistake("local b = g.bottom\ng:heights(0, 64)"),
              "test.lua:2: heights: called after g.bottom or g.top was read");
    EXPECT_NE(mistake("g:heights(-4096, 64)"), "");
    EXPECT_NE(mistake("g:heights(0)"), "");
    EXPECT_NE(mistakeOf("g:pass3D(\"a\", function(p) g:heights(0, 64) p:setBlock(\"stone\") end)"), "");
    EXPECT_FALSE(recorded("g:heights(0, 100)\n" + std::string(kAllStone), 0, Heights{0, 64}));
    EXPECT_FALSE(recorded(kAllStone, 0, Heights{0, 100}));
}

int scriptVersionOf(std::string_view text) {
    return scriptVersion({std::string(text), "test.lua"}, {"test", ""}, contentBlocks()).value();
}

TEST(ScriptHeights, AreSeenByTheVersion) {
    const std::string stone(kAllStone);
    EXPECT_EQ(scriptVersionOf("g:heights(0, 256)\n" + stone), scriptVersionOf(stone));
    EXPECT_NE(scriptVersionOf("g:heights(0, 272)\n" + stone), scriptVersionOf(stone));
    const auto deep = [](const std::string& block) {
        return scriptVersionOf(R"(g:pass3D("a", function(p)
            p:setBlock("stone")
            if g.bottom < 0 then p:setBlock(select(p.z:lt(0), ")" +
                               block + R"(", "stone")) end
        end))");
    };
    EXPECT_NE(deep("dirt"), deep("gravel"));
}

// A chunk may take as long as one of 256 layers.
TEST(ScriptHeights, OfTallWorldsLeaveLessWorkForAVoxel) {
    const auto mistake = [](int operations, Heights heights) {
        auto graph = recorded(fmt::format(R"(g:pass3D("a", function(p)
            local v = p:var(p.z)
            p:while_(function() return v.value:gt(5) end, function()
                for k = 1, {} do v.value = v.value * 3 + k end
            end)
            p:setBlock(select(v.value:gt(0), "stone", "air"))
        end))",
                                          operations),
                              0, heights);
        return graph ? "" : graph.error().message;
    };
    EXPECT_EQ(mistake(40, {0, 256}), "");
    EXPECT_EQ(mistake(1, {-2048, 2048}), "");
    const std::string tooMuch = mistake(40, {-2048, 2048});
    EXPECT_NE(tooMuch.find("operations per voxel, 6250 are allowed"), std::string::npos) << tooMuch;
}

}  // namespace
}  // namespace terrane::lua
