// The tint of a generator: what is wrong with one, its colors at every level, and that chunks know nothing of
// it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "terrane/gen/language/builder.h"
#include "terrane/gen/level_generators.h"
#include "tests/gen/gen_fixture.h"

namespace terrane::gen {
namespace {

using testing::HasSubstr;

void addGround(GeneratorBuilder& g) {
    g.pass3D("ground", [](Pass& p) { p.setBlock(select(p.z() < 9, p.block("stone"), p.block("air"))); });
}

std::string tintErrorOf(const Write& write) {
    const auto graph = tryToBuild([&](GeneratorBuilder& g) {
        write(g);
        addGround(g);
    });
    EXPECT_FALSE(graph.has_value());
    return graph ? "" : graph.error().message;
}

TEST(TintErrors, ATintIsGivenOnce) {
    const std::string error = tintErrorOf([](GeneratorBuilder& g) {
        const auto a = g.field<Int>("a"), b = g.field<Int>("b");
        g.pass2D("colors", [&](Pass& p) {
            p.set(a, Int(1));
            p.set(b, Int(2));
        });
        g.tint(a);
        g.tint(b);
    });
    EXPECT_EQ(error, "generator \"test\": tint is given twice");
}

TEST(TintErrors, ATintIsAFieldOfPackedColors) {
    const std::string error = tintErrorOf([](GeneratorBuilder& g) {
        const auto warmth = g.field<Float>("warmth");
        g.pass2D("climate", [&](Pass& p) { p.set(warmth, Float(0.5f)); });
        g.tint(warmth);
    });
    EXPECT_EQ(error, "generator \"test\": tint: field \"warmth\" holds no packed colors, which are Int");
    EXPECT_EQ(tintErrorOf([](GeneratorBuilder& g) { g.tint(g.field<Int>("colors")); }),
              "generator \"test\": tint: no pass writes field \"colors\"");
}

TEST(TintErrors, ATintNeedsNoBlocks) {
    const auto withTop = [](const std::function<void(GeneratorBuilder&, Field<Int>, Field<Int>)>& write) {
        return tintErrorOf([&](GeneratorBuilder& g) {
            const auto top = g.field<Int>("top"), colors = g.field<Int>("colors");
            g.pass3D("rock", [&](Pass& p) {
                p.setBlock(p.block("stone"));
                p.setAt(top, Int(80), p.z());
            });
            write(g, top, colors);
            g.tint(colors);
        });
    };
    const char* const expected = "tint: field \"colors\" needs the 3D pass \"rock\"";
    EXPECT_THAT(withTop([](GeneratorBuilder& g, Field<Int> top, Field<Int> colors) {
                    g.pass2D("colors", [&](Pass& p) { p.set(colors, p.read(top)); });
                }),
                HasSubstr(expected));
    EXPECT_THAT(withTop([](GeneratorBuilder& g, Field<Int>, Field<Int> colors) {
                    g.pass2D("colors", [&](Pass& p) {
                        p.set(colors, select(p.blockInColumn(3) == p.block("stone"), Int(1), Int(2)));
                    });
                }),
                HasSubstr(expected));
}

// Colors that differ from block to block and say where they are.
world::PackedColor colorAt(std::int32_t x, std::int32_t y) {
    const auto byte = [](std::int32_t v) { return static_cast<std::uint32_t>(v) >> 3 & 255u; };
    return byte(x) << 16 | byte(y) << 8 | (byte(x ^ y) & 127u);
}

base::Result<GeneratorGraph> places(int level) {
    GeneratorBuilder g("places", testBlocks(), level);
    const auto low = g.field<Int>("low"), colors = g.field<Int>("colors");
    g.pass2D("low", [&](Pass& p) { p.set(low, ((p.x() ^ p.y()) >> 3) & 127); });
    g.pass2D("colors", [&](Pass& p) {
        const Int rest = ((p.x() >> 3) & 255) << 16 | ((p.y() >> 3) & 255) << 8;
        p.set(colors, rest | p.readAt(low, {0, 0}));
    });
    g.tint(colors);
    addGround(g);
    return g.finish();
}

// So a column of any level has the color of its block, wherever it is.
TEST(Tint, EveryLevelHasTheColorsOfItsBlocks) {
    const LevelGenerators generators(places, kTestSeed);
    for (int level = 0; level <= world::kMaxLevel; ++level) {
        for (const ChunkPos pos : placesOf(level)) {
            const auto tile = generators.tint(pos);
            ASSERT_TRUE(tile);
            for (int k = 0; k < 256; ++k) {
                const world::BlockPos corner = world::blockPos(pos, static_cast<world::BlockIndex>(k));
                const std::int32_t middle = world::columnWidth(level) / 2;
                ASSERT_EQ((*tile)[static_cast<std::size_t>(k)], colorAt(corner.x + middle, corner.y + middle))
                    << testing::PrintToString(pos) << ", column " << k;
            }
        }
    }
    EXPECT_THROW(static_cast<void>(generators.tint({0, 0, world::kMaxLevel + 1})), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(generators.tint({world::kMaxChunk, 0, 3})), std::invalid_argument);
}

TEST(Tint, ChunksPayNothingForIt) {
    const GeneratorGraph graph = places(0).value();
    EXPECT_EQ(graph.passes.size(), 1u) << "both 2D passes are the tint's";
    ASSERT_TRUE(graph.tint);
    EXPECT_EQ(graph.tint->passes.passes.size(), 2u);

    // A field that blocks need too stays in their passes, and what they alone need is not in the tint's.
    const GeneratorGraph shared = build([](GeneratorBuilder& g) {
        const auto height = g.field<Int>("height"), wet = g.field<Int>("wet"),
                   colors = g.field<Int>("colors");
        g.pass2D("wet", [&](Pass& p) { p.set(wet, p.x() & 3); });
        g.pass2D("land", [&](Pass& p) {
            p.set(height, p.x() & 31);
            p.set(colors, p.read(wet) + p.y());
        });
        g.tint(colors);
        g.pass3D("ground", [&](Pass& p) {
            p.setBlock(select(p.z() < p.read(height), p.block("stone"), p.block("air")));
        });
    });
    EXPECT_EQ(shared.passes.size(), 3u);
    ASSERT_EQ(shared.passes[1].fields.size(), 1u) << "the height, without the colors";
    EXPECT_EQ(shared.fields[shared.passes[1].fields[0].field].name, "height");
    ASSERT_EQ(shared.tint->passes.passes.size(), 2u);
    ASSERT_EQ(shared.tint->passes.passes[1].fields.size(), 1u) << "the colors, without the height";
    const Generator chunks(shared, kTestSeed), tint(shared.tint->passes, kTestSeed);
    expectChunk(chunks, {5, -3},
                [](std::int32_t x, std::int32_t, std::int32_t z) { return z < (x & 31) ? 1 : 0; });
    EXPECT_EQ(tint.columns({0, 1}, shared.tint->field)[16 * 2 + 3], 3u + 18u);
}

TEST(Tint, PackedColorsAreRoundedAndClamped) {
    const LevelGenerators generators(
        [](int level) {
            GeneratorBuilder g("one color", testBlocks(), level);
            const auto colors = g.field<Int>("colors");
            g.pass2D("colors", [&](Pass& p) {
                const Float left = Float(p.x() & 1);
                p.set(colors, packColor(0.5f + left, -0.25f + left * 0.0f, 200.4f / 255.0f + left * 0.0f));
            });
            g.tint(colors);
            addGround(g);
            return g.finish();
        },
        kTestSeed);
    const world::TintTile tile = generators.tint({0, 0}).value();
    EXPECT_EQ(tile[0], world::packColor(128, 0, 200));
    EXPECT_EQ(tile[1], world::packColor(255, 0, 200));
}

TEST(Tint, AGeneratorMayHaveNone) {
    std::vector<int> made;
    const LevelGenerators generators(
        [&](int level) {
            made.push_back(level);
            GeneratorBuilder g("plain", testBlocks(), level);
            addGround(g);
            return g.finish();
        },
        kTestSeed);
    EXPECT_FALSE(generators.hasTint());
    EXPECT_FALSE(generators.tint({0, 0, 4}));
    EXPECT_EQ(made, std::vector<int>{0}) << "what level 0 lacks no other level has";
    EXPECT_TRUE(LevelGenerators(places, kTestSeed).hasTint());
}

TEST(Tint, SomeLevelsMayHaveNone) {
    const LevelGenerators generators(
        [](int level) {
            GeneratorBuilder g("near", testBlocks(), level);
            const auto colors = g.field<Int>("colors");
            g.pass2D("colors", [&](Pass& p) { p.set(colors, Int(5)); });
            if (level < 2) g.tint(colors);
            addGround(g);
            return g.finish();
        },
        kTestSeed);
    for (int order = 0; order < 2; ++order) {
        EXPECT_FALSE(generators.tint({0, 0, 4}));
        EXPECT_TRUE(generators.tint({0, 0, 1}));
        EXPECT_TRUE(generators.hasTint());
    }
}

}  // namespace
}  // namespace terrane::gen
