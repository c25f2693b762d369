// Fields, branches, loops, blocks, shapes, trees, drainage maps and tints as scripts write them.
#include "terrane/gen/compile/generator_graph.h"
#include "terrane/gen/generators/trees/trees.h"
#include "terrane/lua/recording_internal.h"
#include "tests/lua/lua_fixture.h"

namespace terrane::lua {
namespace {

using namespace gen;

void expectEqual(const std::string& text, const std::function<void(GeneratorBuilder&)>& write) {
    for (const int level : {0, 2}) {
        const auto script = recorded(text, level);
        ASSERT_TRUE(script) << script.error().message;
        GeneratorBuilder builder("test", contentBlocks(), level);
        write(builder);
        const auto cpp = builder.finish();
        ASSERT_TRUE(cpp) << cpp.error().message;
        EXPECT_EQ(graphHash(*script), graphHash(*cpp)) << text;
    }
}

TEST(GeneratorLanguage, FieldsOfAllTypes) {
    expectEqual(R"(
        local b, i = g:field("b", "bool"), g:field("i", "int")
        local f, k = g:field("f", "float"), g:field("k", "block")
        g:pass2D("first", function(p)
            p:set(b, p.x:lt(3))
            p:set(i, p.x)
            p:set(f, 2)
            p:set(k, "dirt")
        end)
        g:pass3D("ground", function(p)
            local here = p:readAt(i, -3, 4)
            local slope = p:slope(f)
            local between = p:readBetween(f, vec2(0.5, 1.5)) + p:lowestBeside(f)
            local value = select(slope.x:lt(between), p:read(k), "stone")
            p:setBlock(select(p.z:lt(here) & p:read(b), value, "air"))
        end))",
                [](GeneratorBuilder& g) {
                    const auto b = g.field<Bool>("b");
                    const auto i = g.field<Int>("i");
                    const auto f = g.field<Float>("f");
                    const auto k = g.field<Block>("k");
                    g.pass2D("first", [&](Pass& p) {
                        p.set(b, p.x() < 3);
                        p.set(i, p.x());
                        p.set(f, Float(2.0f));
                        p.set(k, p.block("dirt"));
                    });
                    g.pass3D("ground", [&](Pass& p) {
                        const Int here = p.readAt(i, {-3, 4});
                        const Vec2 slope = p.slope(f);
                        const Float between = p.readBetween(f, {0.5f, 1.5f}) + p.lowestBeside(f);
                        const Bool isFlat = slope.x < between;
                        const Block value = select(isFlat, p.read(k), p.block("stone"));
                        const Bool isLow = p.z() < here;
                        p.setBlock(select(isLow && p.read(b), value, p.block("air")));
                    });
                });
}

TEST(GeneratorLanguage, BranchesLoopsAndBlocksOfThePassBefore) {
    expectEqual(R"(
        local top = g:field("top", "int")
        g:pass3D("ground", function(p)
            p:setBlock("stone")
            p:setAt(top, 90, p.x)
        end)
        g:pass3D("second", function(p)
            local steps, block = p:var(0), p:var("air")
            p:while_(function() return steps.value:lt(p:read(top)) end, function()
                steps.value = steps.value + 3
            end)
            p:if_(steps.value:gt(40), function() block.value = p:blockHere() end,
                function() block.value = p:blockInColumn(p.z - 1) end)
            p:if_(block.value:ne("air"), function() p:setBlock(p:blockAt(1, -1, p.z + 2)) end)
        end))",
                [](GeneratorBuilder& g) {
                    const auto top = g.field<Int>("top");
                    g.pass3D("ground", [&](Pass& p) {
                        p.setBlock(p.block("stone"));
                        p.setAt(top, Int(90), p.x());
                    });
                    g.pass3D("second", [&](Pass& p) {
                        Var<Int> steps = p.var(Int(0));
                        Var<Block> block = p.var(p.block("air"));
                        p.while_([&] { return static_cast<Int>(steps) < p.read(top); },
                                 [&] { steps = steps + 3; });
                        p.if_(
                            static_cast<Int>(steps) > 40, [&] { block = p.blockHere(); },
                            [&] { block = p.blockInColumn(p.z() - 1); });
                        p.if_(static_cast<Block>(block) != p.block("air"), [&] {
                            p.setBlock(p.blockAt({1, -1}, p.z() + 2));
                        });
                    });
                });
}

TEST(GeneratorLanguage, TreesAndShapes) {
    expectEqual(
        R"(
        local trees = g:trees()
        assert(trees.oak.wood == "oak_log" and trees.deadTree.first > 0 and trees.giantMushroom.cover > 10)
        local stone = g:shape {name = "pebble", blocks = {{name = "stone", rank = 2}, {name = "moss"}},
            voxels = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 0, 1, 2}}}
        local foot, base = g:field("foot", "int"), g:field("base", "int")
        g:pass2D("feet", function(p)
            local hash = p.x & 0xFFFFFF
            p:set(foot, select(p.y:lt(0), shapeOf(trees.oldOak, hash), stone))
            p:set(base, 80)
        end)
        g:pass3D("ground", function(p) p:setBlock(p:stamp(foot, base)) end))",
        [](GeneratorBuilder& g) {
            const trees::TreeKinds kinds = trees::record(g);
            const int stone =
                g.shape({"pebble", {{"stone", 2}, {"moss", 0}}, {{0, 0, 0, 0}, {1, 0, 0, 0}, {0, 0, 1, 1}}});
            const auto foot = g.field<Int>("foot"), base = g.field<Int>("base");
            g.pass2D("feet", [&](Pass& p) {
                const Int hash = p.x() & 0xFFFFFF;
                const Bool isSouth = p.y() < 0;
                p.set(foot,
                      select(isSouth, trees::shapeOf(of(kinds, trees::Kind::OldOak), hash), Int(stone)));
                p.set(base, Int(80));
            });
            g.pass3D("ground", [&](Pass& p) { p.setBlock(p.stamp(foot, base)); });
        });
}

TEST(GeneratorLanguage, AListChoosesKindsOfTrees) {
    expectEqual(
        R"(
        local trees = g:trees {"youngFir", "oak"}
        assert(trees.birch == nil and trees.oak.first == 0 and trees.youngFir.first == trees.oak.count)
        local foot, base = g:field("foot", "int"), g:field("base", "int")
        g:pass2D("feet", function(p)
            p:set(foot, shapeOf(trees.youngFir, p.x & 0xFFFFFF))
            p:set(base, 80)
        end)
        g:pass3D("ground", function(p) p:setBlock(p:stamp(foot, base)) end))",
        [](GeneratorBuilder& g) {
            const trees::TreeKinds kinds =
                trees::record(g, std::vector{trees::Kind::Oak, trees::Kind::YoungFir});
            const auto foot = g.field<Int>("foot"), base = g.field<Int>("base");
            g.pass2D("feet", [&](Pass& p) {
                p.set(foot, trees::shapeOf(of(kinds, trees::Kind::YoungFir), p.x() & 0xFFFFFF));
                p.set(base, Int(80));
            });
            g.pass3D("ground", [&](Pass& p) { p.setBlock(p.stamp(foot, base)); });
        });
}

TEST(GeneratorLanguage, DrainageMaps) {
    expectEqual(R"(
        local function wide(p) return 100 + p:perlin2D("wide", 128, {5, 10}) end
        local rivers = g:drainage("rivers", {spacing = 128, seaLevel = 80, minFlow = 4, halfWidth = 1.5}, wide)
        local level = g:field("level", "float")
        g:pass2D("land", function(p)
            local s = p:drainage(rivers)
            p:set(level, select(s.distance:lt(s.halfWidth), s.level, s.lakeLevel))
        end)
        g:pass3D("ground", function(p) p:setBlock(select(float(p.z):lt(p:read(level)), "water", "air")) end))",
                [](GeneratorBuilder& g) {
                    const auto wide = [](Pass& p) { return 100.0f + p.perlin2D("wide", 128, {5.0f, 10.0f}); };
                    DrainageSpec spec;
                    spec.spacing = 128;
                    spec.seaLevel = 80;
                    spec.minFlow = 4;
                    spec.halfWidth = 1.5f;
                    const Drainage rivers = g.drainage("rivers", spec, wide);
                    const auto level = g.field<Float>("level");
                    g.pass2D("land", [&](Pass& p) {
                        const DrainageSample s = p.drainage(rivers);
                        p.set(level, select(s.distance < s.halfWidth, s.level, s.lakeLevel));
                    });
                    g.pass3D("ground", [&](Pass& p) {
                        const Float z(p.z()), water = p.read(level);
                        const Bool isWet = z < water;
                        p.setBlock(select(isWet, p.block("water"), p.block("air")));
                    });
                });
}

TEST(GeneratorLanguage, Valleys) {
    expectEqual(R"(
        local rivers = g:drainage("rivers", {spacing = 64, reach = 64},
            function(p) return 100 + p:perlin2D("wide", 128, {5, 10}) end,
            function(p) return 0.1 + 0.05 * p:perlin2D("steep", 512, {1}) end)
        local height = g:field("height", "float")
        g:pass2D("land", function(p)
            local v = p:valleys(rivers)
            p:set(height, v.level + v.distance * 0.2 + v.flow)
        end)
        g:pass3D("ground", function(p) p:setBlock(select(float(p.z):lt(p:read(height)), "stone", "air")) end))",
                [](GeneratorBuilder& g) {
                    const auto wide = [](Pass& p) { return 100.0f + p.perlin2D("wide", 128, {5.0f, 10.0f}); };
                    const auto steep = [](Pass& p) {
                        return 0.1f + 0.05f * p.perlin2D("steep", 512, {1.0f});
                    };
                    DrainageSpec spec;
                    spec.spacing = 64;
                    spec.reach = 64;
                    const Drainage rivers = g.drainage("rivers", spec, wide, steep);
                    const auto height = g.field<Float>("height");
                    g.pass2D("land", [&](Pass& p) {
                        const ValleySample v = p.valleys(rivers);
                        p.set(height, v.level + v.distance * 0.2f + v.flow);
                    });
                    g.pass3D("ground", [&](Pass& p) {
                        const Float z(p.z());
                        const Bool isGround = z < p.read(height);
                        p.setBlock(select(isGround, p.block("stone"), p.block("air")));
                    });
                });
}

// The constant gradient 0 is one: the map has valleys.
TEST(GeneratorLanguage, AGradientMayBeANumber) {
    const auto graph = recorded(R"(
        local rivers = g:drainage("rivers", {}, function(p) return 100 end, function(p) return 0 end)
        local height = g:field("height", "float")
        g:pass2D("land", function(p) p:set(height, p:valleys(rivers).level) end)
        g:pass3D("ground", function(p) p:setBlock(select(float(p.z):lt(p:read(height)), "stone", "air")) end))");
    ASSERT_TRUE(graph) << graph.error().message;
    EXPECT_TRUE(graph->drainages.front().hasValleys());
}

TEST(GeneratorLanguage, Tints) {
    const auto graph = recorded(R"(
        local color = g:field("color", "int")
        g:pass2D("colors", function(p) p:set(color, packColor(0.5, 0.25, p:random2D("blue"))) end)
        g:tint(color)
        g:pass3D("ground", function(p) p:setBlock("grass") end))");
    ASSERT_TRUE(graph) << graph.error().message;
    EXPECT_NE(graph->tint, nullptr);
}

// A block of the pack comes before one of the same name without it.
TEST(GeneratorLanguage, BlocksOfThePackComeFirst) {
    const world::BlockRegistry registry = parseBlocks(R"(
[[block]]
name = "stone"
shape = "cube"
texture = "stone"
[[block]]
name = "dirt"
shape = "cube"
texture = "dirt"
[[block]]
name = "moor_stone"
shape = "cube"
texture = "stone"
)",
                                                      "blocks");
    // Content files have no colons in names.
    BlockNames names(registry, "moor", {{"moor:stone", "moor_stone"}});
    EXPECT_EQ(names.find("stone"), "moor_stone");
    EXPECT_EQ(names.find("dirt"), "dirt");
    EXPECT_EQ(names.find("stone"), "moor_stone");
    EXPECT_EQ(names.find("air"), "air");
    EXPECT_EQ(names.used(), (std::vector<std::string>{"moor_stone", "dirt"}));
    EXPECT_THROW((void)names.find("snow"), std::runtime_error);
    EXPECT_EQ(BlockNames(registry, "").find("stone"), "stone");
}

}  // namespace
}  // namespace terrane::lua
