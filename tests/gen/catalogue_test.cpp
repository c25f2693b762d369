#include "terrane/gen/generators/catalogue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "tests/gen/gen_fixture.h"

namespace terrane::gen {
namespace {

using testing::HasSubstr;

TEST(Catalogue, NamesTheGeneratorsThatComeWithTerrane) {
    const std::vector<std::string> names = generatorNames();
    EXPECT_THAT(names, testing::IsSupersetOf({"overworld", "flat"}));
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size()) << "each name once";
}

TEST(Catalogue, EveryGeneratorIsWithoutMistakes) {
    for (const std::string& name : generatorNames()) {
        const auto graph = makeGenerator(name, contentBlocks());
        ASSERT_TRUE(graph.has_value()) << graph.error().message;
        EXPECT_EQ(graph->name, name);
        EXPECT_FALSE(graph->passes.empty());
        EXPECT_TRUE(graph->passes.back().is3D);
    }
}

TEST(Catalogue, AnUnknownNameListsTheKnownOnes) {
    const auto graph = makeGenerator("underworld", contentBlocks());
    ASSERT_FALSE(graph.has_value());
    EXPECT_THAT(graph.error().message, HasSubstr("unknown generator \"underworld\""));
    for (const std::string& name : generatorNames()) EXPECT_THAT(graph.error().message, HasSubstr(name));
}

// A content file without the blocks a generator is made of: all that are missing are named at once.
TEST(Catalogue, BlocksThatTheContentLacksAreNamed) {
    const auto graph = makeGenerator("flat", parseBlocks(R"(
[[block]]
name = "stone"
shape = "cube"
texture = "stone"
)",
                                                         "little"));
    ASSERT_FALSE(graph.has_value());
    EXPECT_THAT(graph.error().message, HasSubstr("unknown block \"grass\""));
    EXPECT_THAT(graph.error().message, HasSubstr("unknown block \"dirt\""));
    EXPECT_THAT(graph.error().message, testing::Not(HasSubstr("\"stone\"")));
}

}  // namespace
}  // namespace terrane::gen
