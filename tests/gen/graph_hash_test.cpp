#include "terrane/gen/compile/generator_graph.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <vector>

#include "terrane/gen/generators/catalogue.h"
#include "terrane/gen/language/builder.h"
#include "tests/world/content_blocks.h"

namespace terrane::gen {
namespace {

GeneratorGraph graphOf(const std::string& name, int level = 0) {
    return makeGenerator(name, contentBlocks(), level).value();
}

TEST(GraphHash, IsEqualForEqualGenerators) {
    for (const std::string& name : namesOf(builtInGenerators()))
        EXPECT_EQ(graphHash(graphOf(name)), graphHash(graphOf(name))) << name;
}

TEST(GraphHash, TellsGeneratorsAndLevelsApart) {
    std::map<std::uint64_t, std::string> found;
    for (const std::string& name : namesOf(builtInGenerators()))
        for (const int level : {0, 1, 5}) {
            const auto [at, isNew] = found.emplace(graphHash(graphOf(name, level)), name);
            EXPECT_TRUE(isNew) << name << " level " << level << " and " << at->second;
        }
}

// Each part that blocks depend on.
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
        [](auto& g) { g.passes.front().fields.front().isWritten = 0; },
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

// A pass that writes the block that `shade` computes.
std::uint64_t hashOfPass(const std::function<Float(Pass&)>& shade) {
    GeneratorBuilder builder("test", contentBlocks());
    builder.pass3D("blocks",
                   [&](Pass& p) { p.setBlock(select(shade(p) > 0.0f, p.block("stone"), p.block("air"))); });
    return graphHash(builder.finish().value());
}

Float hills(Pass& p) {
    return p.perlin2D("hills", 32, {1.0f});
}

Float rolled(Pass& p, std::string_view name) {
    return p.random2D(name, p.x(), p.y());
}

// Doubles `initial` until it is at least `end`.
Float doubled(Pass& p, Float initial, Float end) {
    auto value = p.var<Float>(initial);
    p.while_([&] { return Float(value) < end; }, [&] { value = Float(value) * 2.0f; });
    return value;
}

// Argument by argument in one order and in the other, as compilers choose.
TEST(GraphHash, IsEqualWhateverTheOrderOfRecording) {
    const std::uint64_t sum = hashOfPass([](Pass& p) {
        const Float a = hills(p), b = rolled(p, "b"), c = rolled(p, "c");
        return (a + b) * c - b;
    });
    EXPECT_EQ(sum, hashOfPass([](Pass& p) {
                  const Float c = rolled(p, "c"), b = rolled(p, "b"), a = hills(p);
                  return c * (b + a) - b;
              }));
    EXPECT_NE(sum, hashOfPass([](Pass& p) {
                  const Float a = hills(p), b = rolled(p, "b"), c = rolled(p, "c");
                  return (a + b) * c - a;
              }));
    const std::uint64_t loops = hashOfPass([](Pass& p) {
        const Float a = doubled(p, hills(p), 4.0f), b = doubled(p, rolled(p, "b"), 3.0f);
        return a - b;
    });
    EXPECT_EQ(loops, hashOfPass([](Pass& p) {
                  const Float b = doubled(p, rolled(p, "b"), 3.0f), a = doubled(p, hills(p), 4.0f);
                  return a - b;
              }));
    EXPECT_NE(loops, hashOfPass([](Pass& p) {
                  const Float a = doubled(p, hills(p), 3.0f), b = doubled(p, rolled(p, "b"), 4.0f);
                  return a - b;
              }));
}

}  // namespace
}  // namespace terrane::gen
