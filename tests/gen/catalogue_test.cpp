#include "terrane/gen/generators/catalogue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "terrane/base/digest.h"
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

// Twenty chunks by the names of their blocks: the ids may change with the content file.
std::string digestOf(const std::string& name) {
    const Generator generator(makeGenerator(name, contentBlocks()).value(), kTestSeed);
    base::Digest digest;
    std::map<BlockId, std::uint16_t> numbers;  // of the blocks in the order in which they are met
    for (std::int32_t k = 0; k < 20; ++k) {
        for (const BlockId id : blocksOf(generator.generate({53 * k - 500, 700 - 71 * k}))) {
            const auto [number, isNew] = numbers.try_emplace(id, static_cast<std::uint16_t>(numbers.size()));
            if (isNew) digest.update(contentBlocks().type(id).name);
            digest.update(std::as_bytes(std::span(&number->second, 1)));
        }
    }
    return digest.hex();
}

struct Pinned {
    int version;
    std::string digest;
};

TEST(Catalogue, AVersionAlwaysMakesTheSameBlocks) {
    const std::map<std::string, Pinned> pinned = {{"overworld", {2, "247563b3f32dad0f2eae5650c6696f48"}},
                                                  {"flat", {1, "4d68fdbedf2c769f7ee583e97eec48d1"}},
                                                  {"hills3d", {1, "80f368ad4c46696c44247587b0ba3ac9"}},
                                                  {"voronoi", {1, "4b6e6a3b3283b87d7c6373b014117425"}}};
    for (const std::string& name : generatorNames()) {
        const std::string digest = digestOf(name);
        ASSERT_TRUE(pinned.contains(name)) << name << " is new: pin its digest " << digest;
        EXPECT_EQ(digest, pinned.at(name).digest)
            << "the generator " << name
            << " makes other blocks than before: raise its version in catalogue.cpp, "
            << "or saves mix chunks that do not fit together, and pin version and digest here";
        EXPECT_EQ(generatorVersion(name), pinned.at(name).version)
            << name << " has a new version: pin it here, with its digest";
    }
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
