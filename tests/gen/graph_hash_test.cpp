#include "terrane/gen/graph_hash.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <vector>

#include "terrane/gen/generators/catalogue.h"
#include "tests/world/content_blocks.h"

namespace terrane::gen {
namespace {

GeneratorGraph graphOf(const std::string& name, int level = 0) {
    return makeGenerator(name, contentBlocks(), level).value();
}

TEST(GraphHash, IsEqualForEqualGenerators) {
    for (const char* name : {"continents", "overworld", "flat"})
        EXPECT_EQ(graphHash(graphOf(name)), graphHash(graphOf(name))) << name;
}

TEST(GraphHash, TellsGeneratorsAndLevelsApart) {
    std::map<std::uint64_t, std::string> found;
    for (const char* name : {"continents", "overworld", "flat"})
        for (const int level : {0, 1, 5}) {
            const auto [at, isNew] = found.emplace(graphHash(graphOf(name, level)), name);
            EXPECT_TRUE(isNew) << name << " level " << level << " and " << at->second;
        }
}

// Each part that blocks follow from.
TEST(GraphHash, SeesEveryChange) {
    const GeneratorGraph original = graphOf("continents");
    ASSERT_FALSE(original.noises.empty() || original.drainages.empty() || !original.shapes);
    const std::vector<std::function<void(GeneratorGraph&)>> changes{
        [](auto& g) { g.noises.back().size += 1; },
        [](auto& g) { g.noises.front().name += "x"; },
        [](auto& g) { g.hashNames.back() += "x"; },
        [](auto& g) { g.drainages.front().spec.spacing *= 2; },
        [](auto& g) { g.drainages.front().spec.bend += 0.01f; },
        [](auto& g) { g.passes.back().block = *g.passes.back().block - 1; },
        [](auto& g) { g.passes.front().fields.front().value += 1; },
        [](auto& g) { g.passes.back().graph.constant(Type::Int, 123456789); },
        [](auto& g) {
            auto shapes = std::make_shared<ShapeTable>(*g.shapes);
            shapes->runs.back().block += 1;
            g.shapes = shapes;
        },
    };
    for (std::size_t k = 0; k < changes.size(); ++k) {
        GeneratorGraph changed = original;
        changes[k](changed);
        EXPECT_NE(graphHash(changed), graphHash(original)) << k;
    }
}

}  // namespace
}  // namespace terrane::gen
