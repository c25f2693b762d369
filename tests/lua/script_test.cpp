// Scripts give the same blocks as the C++ that they mirror, and versions that say what changed.
#include "terrane/lua/script.h"

#include <thread>

#include "examples/tutorial_generators.h"
#include "terrane/gen/compile/generator_graph.h"
#include "terrane/gen/generators/catalogue.h"
#include "tests/lua/lua_fixture.h"

namespace terrane::lua {
namespace {

using gen::GeneratorGraph;
using world::ChunkPos;

base::Result<GeneratorGraph> graphOfCpp(const std::string& name, int level) {
    if (name != "tutorial") return gen::makeGenerator(name, contentBlocks(), level);
    gen::GeneratorBuilder builder(name, contentBlocks(), level);
    examples::writeStep4(builder);
    return builder.finish();
}

class ScriptEqualsCpp : public testing::TestWithParam<const char*> {};

TEST_P(ScriptEqualsCpp, AtEveryLevel) {
    for (const int level : {0, 1, 2, 5, world::kMaxLevel}) {
        auto script = recordScript(exampleScript(GetParam()), {GetParam(), ""}, contentBlocks(), {level, {}});
        ASSERT_TRUE(script) << script.error().message;
        auto cpp = graphOfCpp(GetParam(), level);
        ASSERT_TRUE(cpp) << cpp.error().message;
        const gen::Generator ofScript(*std::move(script), 7), ofCpp(*std::move(cpp), 7);
        for (int k = 0; k < (level == 0 ? 9 : 3); ++k) {
            const ChunkPos pos{k * 5 - 12, k * 3 - 7, static_cast<std::uint8_t>(level)};
            EXPECT_EQ(gen::blocksOf(ofScript.generate(pos)), gen::blocksOf(ofCpp.generate(pos)))
                << testing::PrintToString(pos);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Generators, ScriptEqualsCpp, testing::Values("hills3d", "voronoi", "tutorial"));

int versionOf(std::string_view text, std::string_view pack = "",
              const world::BlockRegistry& blocks = contentBlocks()) {
    const auto version = scriptVersion({std::string(text), "test.lua"}, {"test", std::string(pack)}, blocks);
    EXPECT_TRUE(version) << version.error().message;
    return version.value_or(0);
}

constexpr std::string_view kStone =
    R"(g:pass3D("a", function(p) p:setBlock(select(p.z:lt(80), "stone", "air")) end))";

TEST(ScriptVersion, SeesWhatBlocksFollowFromAndNothingElse) {
    const int version = versionOf(kStone);
    EXPECT_GT(version, 0);
    EXPECT_EQ(version, versionOf(kStone));
    EXPECT_EQ(version, versionOf("-- the next step\n" + std::string(kStone)));
    EXPECT_EQ(version, versionOf(R"(-- words
        local low <const> = 80
        g:pass3D("another name", function(p) p:setBlock(select(p.z:lt(low), "stone", "air")) end))"));
    EXPECT_NE(version,
              versionOf(R"(g:pass3D("a", function(p) p:setBlock(select(p.z:lt(81), "stone", "air")) end))"));
    EXPECT_NE(version,
              versionOf(R"(g:pass3D("a", function(p) p:setBlock(select(p.z:lt(80), "dirt", "air")) end))"));
}

std::string cubes(std::initializer_list<std::string_view> names) {
    std::string toml;
    for (const std::string_view name : names)
        toml += fmt::format("[[block]]\nname = \"{}\"\nshape = \"cube\"\ntexture = \"stone\"\n", name);
    return toml;
}

TEST(ScriptVersion, DoesNotDependOnOtherBlocks) {
    const world::BlockRegistry few = gen::parseBlocks(cubes({"stone"}), "few.toml");
    const world::BlockRegistry other =
        gen::parseBlocks(cubes({"dirt", "snow", "stone", "sand"}), "other.toml");
    EXPECT_EQ(versionOf(kStone, "", few), versionOf(kStone, "", other));
    EXPECT_EQ(versionOf(kStone, "", few), versionOf(kStone));
}

TEST(ScriptVersion, IsOneForEachExample) {
    std::map<int, std::string> found;
    for (const auto& path : scriptsIn("examples/lua/generators")) {
        const auto [at, isNew] = found.emplace(versionOf(readText(path)), path.stem());
        EXPECT_TRUE(isNew) << path << " and " << at->second;
    }
}

TEST(Script, PrintsOnceWhenRecordedAndNotForItsVersion) {
    const std::string text = "print(\"step\", g.step)\n" + std::string(kStone);
    testing::internal::CaptureStderr();
    EXPECT_GT(versionOf(text), 0);
    EXPECT_TRUE(recorded(text));
    EXPECT_TRUE(recorded(text, 1));
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "terrane: script: step 1\n");
}

TEST(Script, IsRecordedTheSameByAllThreads) {
    const Script script = exampleScript("08_forest");
    const auto hash = [&] {
        const auto graph = recordScript(script, {"forest", ""}, contentBlocks(), {2, {}});
        return graph ? gen::graphHash(*graph) : 0;
    };
    const std::uint64_t expected = hash();
    ASSERT_NE(expected, 0u);
    std::vector<std::uint64_t> found(8, 0);
    std::vector<std::thread> threads;
    for (std::uint64_t& f : found) threads.emplace_back([&f, &hash] { f = hash(); });
    for (std::thread& t : threads) t.join();
    for (const std::uint64_t f : found) EXPECT_EQ(f, expected);
}

TEST(Script, HasALevel) {
    EXPECT_FALSE(recorded(kStone, -1));
    EXPECT_FALSE(recorded(kStone, world::kMaxLevel + 1));
    const auto graph = recorded(R"(g:pass3D("a", function(p)
        assert(p.step == 8 and g.step == 8)
        p:setBlock("stone")
    end))",
                                3);
    EXPECT_TRUE(graph) << graph.error().message;
}

TEST(Script, TooLargeIsRefused) {
    EXPECT_EQ(mistakeOf(std::string(2 << 20, ' ')), "test.lua: more than 1048576 bytes");
}

}  // namespace
}  // namespace terrane::lua
