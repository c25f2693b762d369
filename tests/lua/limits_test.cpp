// Limits of what a script records: work of a chunk, branches within each other, shapes.
#include "terrane/gen/generators/catalogue.h"
#include "terrane/gen/language/builder.h"
#include "terrane/lua/graph_limits_internal.h"
#include "tests/lua/lua_fixture.h"

namespace terrane::lua {
namespace {

// A chain of ifs of which each uses the last one on one side.
std::string nestedIfs(int count) {
    return fmt::format(R"(
        local f = g:field("f", "int")
        g:pass2D("deep", function(p)
            local v, c = p:var(0), p.x:gt(0)
            for k = 1, {} do
                p:if_(c, function() v.value = v.value + 1 end, function() v.value = 0 end)
            end
            p:set(f, v.value)
        end)
        g:pass3D("ground", function(p) p:setBlock(select(p:read(f):gt(3), "stone", "air")) end))",
                       count);
}

TEST(Limits, OfBranchesWithinEachOther) {
    EXPECT_EQ(mistakeOf(nestedIfs(gen::kMaxBranchDepth)), "");
    for (const int count : {gen::kMaxBranchDepth + 1, gen::kMaxBranchChain, 5'000})
        EXPECT_NE(mistakeOf(nestedIfs(count)).find("pass \"deep\": its branches nest "), std::string::npos);
}

TEST(Limits, OfBranchesCountThoseOfDrainageMaps) {
    EXPECT_NE(mistakeOf(R"(
        g:drainage("d", {}, function(p)
            local v, c = p:var(0.0), p.x:gt(0)
            for k = 1, 100 do
                p:if_(c, function() v.value = v.value + 1 end, function() v.value = 0.0 end)
            end
            return v.value
        end)
        g:pass3D("ground", function(p) p:setBlock("stone") end))")
                  .find("its branches nest 100 levels deep"),
              std::string::npos);
}

// Scripts may branch as much as generators of the program do.
TEST(Limits, OfBranchesAreAboveThoseOfTheProgram) {
    for (const std::string& name : gen::namesOf(gen::builtInGenerators())) {
        const auto graph = gen::makeGenerator(name, contentBlocks(), 0);
        ASSERT_TRUE(graph) << graph.error().message;
        for (const gen::PassGraph& pass : graph->passes) {
            EXPECT_LE(gen::branchDepth(pass), gen::kMaxBranchDepth / 2) << name << " " << pass.name;
            EXPECT_LE(gen::branchChain(pass), gen::kMaxBranchChain / 2) << name << " " << pass.name;
        }
    }
}

// An operation runs for 4 · 369,664 columns, 22.6 for each voxel of a chunk.
TEST(Limits, OfWorkCountTheHeightsOfDrainageMaps) {
    const auto mistake = [](int rounds) {
        return mistakeOf(fmt::format(R"(
            g:drainage("d", {{}}, function(p)
                local v = p.x
                for k = 1, {} do v = v * 3 + k end
                return float(v)
            end)
            g:pass3D("ground", function(p) p:setBlock("stone") end))",
                                     rounds));
    };
    EXPECT_EQ(mistake(1'000), "");
    EXPECT_NE(mistake(2'500).find("operations per voxel"), std::string::npos) << mistake(2'500);
}

TEST(Limits, OfWorkCountTheRunsOfStampedShapes) {
    auto graph = recorded(R"(
        local post = g:shape {name = "post", blocks = {{name = "stone"}}, voxels = {{0, 0, 0, 1}}}
        local shape, base = g:field("shape", "int"), g:field("base", "int")
        g:pass2D("feet", function(p) p:set(shape, post) p:set(base, 80) end)
        g:pass3D("ground", function(p) p:setBlock(p:stamp(shape, base)) end))");
    ASSERT_TRUE(graph) << graph.error().message;
    EXPECT_EQ(unboundedWork(*graph), "");
    // 48² · runs / 65,536 operations per voxel.
    const auto workWith = [&](std::uint32_t runs) {
        gen::ShapeTable table = *graph->shapes;
        table.shapes[0].firstRun.back() = runs;
        graph->shapes = std::make_shared<const gen::ShapeTable>(table);
        return unboundedWork(*graph);
    };
    EXPECT_EQ(workWith(2'800'000), "");
    EXPECT_NE(workWith(2'850'000), "");
}

TEST(Limits, OfWorkAreSeenBeforeMistakesOfCompiling) {
    const std::string mistake = mistakeOf(R"(
        g:pass3D("nested", function(p)
            local v = p:var(p.x)
            local function always() return v.value:gt(0) end
            p:while_(always, function() p:while_(always, function() p:while_(always, function()
                v.value = v.value + 1
            end) end) end)
            p:setBlock(select(v.value:gt(0), "stone", "air"))
        end))");
    EXPECT_EQ(mistake, "test.lua: pass \"nested\": more than 2 nested loops");
}

TEST(Limits, ShapesHaveAFoot) {
    EXPECT_EQ(
        mistakeOf("\ng:shape {name = \"aside\", blocks = {{name = \"stone\"}}, voxels = {{5, 5, 0, 1}}}"),
        "test.lua:2: shape \"aside\": has no voxel at x = y = 0, its foot, which wide columns join the "
        "rest to");
}

// The builder itself reports numbers of fields that it does not have.
TEST(Limits, FieldsOfOtherGeneratorsAreMistakes) {
    using namespace gen;
    constexpr Field<Int> kInt{7};
    constexpr Field<Float> kFloat{7};
    const std::function<void(Pass&)> uses[] = {[&](Pass& p) { (void)p.read(kInt); },
                                               [&](Pass& p) {
                                                   (void)p.readAt(kInt, {1, 0});
                                               },
                                               [&](Pass& p) { (void)p.slope(kFloat); },
                                               [&](Pass& p) { (void)p.lowestBeside(kFloat); },
                                               [&](Pass& p) {
                                                   (void)p.readBetween(kFloat, {1.0f, 0.0f});
                                               },
                                               [&](Pass& p) { p.set(kInt, Int(1)); },
                                               [&](Pass& p) { p.setAt(kInt, Int(1), Int(1)); },
                                               [&](Pass& p) { (void)p.stamp(kInt, kInt); }};
    for (std::size_t k = 0; k < std::size(uses); ++k) {
        GeneratorBuilder g("test", contentBlocks());
        g.pass3D("all", uses[k]);
        const auto graph = g.finish();
        ASSERT_FALSE(graph) << k;
        EXPECT_NE(graph.error().message.find("this generator has no such field"), std::string::npos)
            << k << " " << graph.error().message;
    }
    GeneratorBuilder g("test", contentBlocks());
    g.tint(kInt);
    g.pass3D("all", [](Pass&) {});
    EXPECT_FALSE(g.finish());
}

// Fields, shapes and trees belong before and between passes.
TEST(Limits, NothingIsDeclaredInsideOfAPass) {
    const char* declarations[] = {
        "g:field(\"x\", \"int\")",
        "g:tint(f)",
        "g:trees()",
        "g:shape {name = \"s\", blocks = {{name = \"stone\"}}, voxels = {{0, 0, 0, 1}}}",
        "g:pass2D(\"x\", print)",
        "g:pass3D(\"x\", print)",
        "g:drainage(\"x\", {}, print)"};
    for (const std::string declaration : declarations) {
        for (const char* open : {"g:pass2D(\"a\", function(p) ", "g:pass3D(\"a\", function(p) ",
                                 "g:drainage(\"d\", {}, function(p) "}) {
            const std::string mistake =
                mistakeOf("local f = g:field(\"f\", \"int\")\n" + std::string(open) + declaration + " end)");
            EXPECT_NE(mistake.find(": not inside of a pass"), std::string::npos) << declaration << mistake;
        }
    }
}

}  // namespace
}  // namespace terrane::lua
