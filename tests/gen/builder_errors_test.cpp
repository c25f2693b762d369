// Mistakes in a generator: each message names the pass and the thing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/gen/gen_fixture.h"

namespace terrane::gen {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string errorOf(const Write& write) {
    const auto graph = tryToBuild(write);
    EXPECT_FALSE(graph.has_value());
    return graph ? "" : graph.error().message;
}

// A generator whose first pass is `body` and whose last one is right.
std::string errorIn2D(const std::function<void(Pass&)>& body) {
    return errorOf([&](GeneratorBuilder& g) {
        g.pass2D("faulty", body);
        g.pass3D("fine", [](Pass&) {});
    });
}
std::string errorIn3D(const std::function<void(Pass&)>& body) {
    return errorOf([&](GeneratorBuilder& g) { g.pass3D("faulty", body); });
}

TEST(BuilderErrors, UnknownBlock) {
    EXPECT_EQ(errorIn3D([](Pass& p) { p.setBlock(p.block("marzipan")); }),
              "generator \"test\": pass \"faulty\": unknown block \"marzipan\"");
}

TEST(BuilderErrors, TheSameMistakeCountsOnce) {
    EXPECT_EQ(errorIn3D([](Pass& p) {
                  for (int k = 0; k < 5; ++k) p.setBlock(p.block("marzipan"));
              }),
              "generator \"test\": pass \"faulty\": unknown block \"marzipan\"");
}

TEST(BuilderErrors, SeveralAreReportedTogether) {
    const std::string error = errorOf([](GeneratorBuilder& g) {
        const auto f = g.field<Float>("f");
        g.pass2D("one", [&](Pass& p) { p.set(f, p.read(f)); });
        g.pass3D("two", [](Pass& p) { p.setBlock(p.block("marzipan")); });
        g.pass2D("three", [](Pass& p) { p.perlin2D("n", 0, {1.0f}); });
    });
    EXPECT_THAT(error, HasSubstr("pass \"one\": field \"f\""));
    EXPECT_THAT(error, HasSubstr("pass \"two\": unknown block \"marzipan\""));
    EXPECT_THAT(error, HasSubstr("pass \"three\": noise \"n\""));
    EXPECT_THAT(error, HasSubstr("the last pass must be a 3D pass"));
    EXPECT_THAT(error, Not(HasSubstr("\n"))) << "shown as one line";
}

TEST(BuilderErrors, AFieldReadBeforeItIsWritten) {
    const std::string error = errorOf([](GeneratorBuilder& g) {
        const auto f = g.field<Float>("late");
        g.pass2D("early", [&](Pass& p) {
            p.read(f);
            p.readAt(f, {1, 1});
        });
        g.pass2D("writer", [&](Pass& p) { p.set(f, Float(1.0f)); });
        g.pass3D("fine", [](Pass&) {});
    });
    EXPECT_THAT(error, HasSubstr("pass \"early\": field \"late\" is read, but no earlier pass writes it"));
    EXPECT_THAT(error, Not(HasSubstr("writer")));
}

TEST(BuilderErrors, AFieldReadInThePassThatWritesIt) {
    const std::string error = errorOf([](GeneratorBuilder& g) {
        const auto f = g.field<Float>("own");
        g.pass2D("writer", [&](Pass& p) {
            p.set(f, Float(1.0f));
            p.read(f);
        });
        g.pass3D("fine", [](Pass&) {});
    });
    EXPECT_THAT(error, HasSubstr("pass \"writer\": field \"own\" is read"));
}

TEST(BuilderErrors, AFieldWrittenByTwoPasses) {
    const std::string error = errorOf([](GeneratorBuilder& g) {
        const auto f = g.field<Float>("f");
        g.pass2D("first", [&](Pass& p) { p.set(f, Float(1.0f)); });
        g.pass2D("second", [&](Pass& p) { p.set(f, Float(2.0f)); });
        g.pass3D("fine", [](Pass&) {});
    });
    EXPECT_THAT(error, HasSubstr("pass \"second\": field \"f\" is written by an earlier pass"));
}

TEST(BuilderErrors, AFieldWrittenByA3DPass) {
    const std::string error = errorOf([](GeneratorBuilder& g) {
        const auto f = g.field<Float>("f");
        g.pass3D("solid", [&](Pass& p) { p.set(f, Float(1.0f)); });
    });
    EXPECT_THAT(error, HasSubstr("pass \"solid\": field \"f\": 3D passes write fields with setAt"));
}

TEST(BuilderErrors, SetAtInABranchTwiceOrInTheLastPass) {
    const std::string error = errorOf([](GeneratorBuilder& g) {
        const auto f = g.field<Int>("f"), twice = g.field<Int>("twice"), last = g.field<Int>("last");
        g.pass3D("first", [&](Pass& p) {
            p.if_(p.z() < 9, [&] { p.setAt(f, 3, p.z()); });
            p.setAt(twice, 3, p.z());
            p.setAt(twice, 4, p.z());
        });
        g.pass3D("final", [&](Pass& p) { p.setAt(last, 3, p.z()); });
    });
    EXPECT_THAT(error, HasSubstr("pass \"first\": field \"f\": setAt stands inside if_ or while_"));
    EXPECT_THAT(error, HasSubstr("pass \"first\": field \"twice\" is set twice"));
    EXPECT_THAT(error, HasSubstr("pass \"final\": field \"last\": no later pass could read it"));
}

TEST(BuilderErrors, AValueThatLeavesALoop) {
    const std::string error = errorOf([](GeneratorBuilder& g) {
        g.pass3D("solid", [&](Pass& p) {
            Var<Int> n = p.var(Int(0));
            Int leaked = 0;
            p.while_([&] { return n < p.x(); }, [&] { n = leaked = n + 1; });
            p.setBlock(Block(leaked));
        });
    });
    EXPECT_THAT(error, HasSubstr("pass \"solid\": a value made inside while_ is used after it"));
}

TEST(BuilderErrors, AConditionThatIsAValueOfAnInnerLoop) {
    const std::string error = errorOf([](GeneratorBuilder& g) {
        g.pass3D("solid", [&](Pass& p) {
            Var<Int> n = p.var(Int(0));
            const auto leaking = [&] {
                Bool leaked = false;
                p.while_([&] { return n < p.x(); },
                         [&] {
                             n = n + 1;
                             leaked = n < p.y();
                         });
                return leaked;
            };
            p.while_(leaking, [&] { n = n + 1; });
            p.setBlock(Block(static_cast<Int>(n)));
        });
    });
    EXPECT_THAT(error, HasSubstr("pass \"solid\": a value made inside while_ is used after it"));
}

// Every pass has its own nodes: a number of another one's would be anything, or nothing.
TEST(BuilderErrors, AValueOfAnEarlierPass) {
    const std::string expected = "pass \"second\": a value of another pass is used: write it to a field";
    const auto secondPass = [](const std::function<void(Pass&, Int)>& second) {
        return errorOf([&](GeneratorBuilder& g) {
            Int kept = 0;
            g.pass2D("first", [&](Pass& p) { kept = p.x() * p.y() + 3; });
            g.pass3D("second", [&](Pass& p) { second(p, kept); });
        });
    };
    EXPECT_THAT(secondPass([](Pass& p, Int kept) { p.setBlock(Block(kept)); }), HasSubstr(expected));
    EXPECT_THAT(secondPass([](Pass& p, Int kept) { p.setBlock(Block(kept + 1)); }), HasSubstr(expected));
    EXPECT_THAT(secondPass([](Pass& p, Int kept) { p.setBlock(Block(kept + p.x())); }), HasSubstr(expected));
    EXPECT_THAT(secondPass([](Pass& p, Int kept) { p.setBlock(Block(p.x() + kept)); }), HasSubstr(expected));
    EXPECT_THAT(secondPass([](Pass& p, Int kept) { p.if_(kept < 4, [&] { p.setBlock(Block(1)); }); }),
                HasSubstr(expected));
    EXPECT_THAT(secondPass([](Pass& p, Int kept) { p.while_([&] { return kept < p.x(); }, [] {}); }),
                HasSubstr(expected));
}

TEST(BuilderErrors, AValueOfADrainage) {
    const std::string error = errorOf([](GeneratorBuilder& g) {
        Float kept = 0.0f;
        g.drainage("rivers", {}, [&](Pass& p) { return kept = Float(p.x()); });
        g.pass3D("solid", [&](Pass& p) { p.setBlock(Block(Int(kept))); });
    });
    EXPECT_THAT(error, HasSubstr("pass \"solid\": a value of another pass is used"));
}

// The number of a field stands for another one in another generator.
TEST(BuilderErrors, AFieldOfAnotherGenerator) {
    GeneratorBuilder other("other", testBlocks());
    const auto number = other.field<Float>("number"), beyond = other.field<Float>("beyond");
    const std::string error = errorOf([&](GeneratorBuilder& g) {
        g.field<Int>("own");
        g.pass2D("writes", [&](Pass& p) { p.set(number, Float(1.0f)); });
        g.pass2D("reads", [&](Pass& p) { p.slope(number); });
        g.pass3D("final", [&](Pass& p) { p.read(beyond); });
    });
    EXPECT_THAT(error, HasSubstr("pass \"writes\": field \"own\" holds values of another type"));
    EXPECT_THAT(error, HasSubstr("pass \"reads\": field \"own\" holds values of another type"));
    EXPECT_THAT(error, HasSubstr("pass \"final\": this generator has no such field"));
}

// 5,000 products that are all needed at the end: 16 rows each.
TEST(BuilderErrors, MoreValuesAtOnceThanThereAreRegisters) {
    const std::string error = errorIn3D([](Pass& p) {
        std::vector<Int> products;
        for (int k = 0; k < 5000; ++k) products.push_back(p.x() * p.x() * (k + 3));
        Int sum = 0;
        for (std::size_t k = products.size(); k-- > 0;) sum = sum * 3 + products[k];
        p.setBlock(Block(sum));
    });
    EXPECT_THAT(error, HasSubstr("pass \"faulty\": its values need "));
    EXPECT_THAT(error, HasSubstr("rows of registers, at most 65536 are possible"));
}

TEST(BuilderErrors, AMetricThatIsNone) {
    const std::string error = errorOf([](GeneratorBuilder& g) {
        g.pass3D("solid", [&](Pass& p) { p.setBlock(Block(p.voronoi3D("cells", 8, 1, 1).offset.x)); });
    });
    EXPECT_THAT(error, HasSubstr("noise \"cells\": metric exponent 1, expected 2 to 8"));
}

TEST(BuilderErrors, WeightsThatAreAllZero) {
    const std::string error = errorOf([](GeneratorBuilder& g) {
        g.pass3D("solid", [&](Pass& p) { p.setBlock(Block(Int(p.perlin2D("none", 8, {0.0f, 0.0f})))); });
    });
    EXPECT_THAT(error, HasSubstr("noise \"none\": all octave weights are 0"));
}

TEST(BuilderErrors, OneNameForTwoKindsOfNoise) {
    const std::string error = errorOf([](GeneratorBuilder& g) {
        g.pass3D("solid", [&](Pass& p) {
            const Float sum = p.simplex2D("hills", 8, {1.0f}) + p.perlin2D("hills", 8, {1.0f});
            p.setBlock(Block(Int(sum)));
        });
    });
    EXPECT_THAT(error, HasSubstr("noise \"hills\" is used twice with different parameters"));
}

TEST(BuilderErrors, AFieldDeclaredTwice) {
    const std::string error = errorOf([](GeneratorBuilder& g) {
        g.field<Float>("f");
        g.field<Int>("f");
        g.pass3D("fine", [](Pass&) {});
    });
    EXPECT_THAT(error, HasSubstr("field \"f\" is declared twice"));
}

TEST(BuilderErrors, AFieldDeclaredInThePassThatWritesIt) {
    const std::string error = errorOf([](GeneratorBuilder& g) {
        g.pass2D("late", [&](Pass& p) { p.set(g.field<Float>("f"), Float(1.0f)); });
        g.pass3D("fine", [](Pass&) {});
    });
    EXPECT_THAT(error, HasSubstr("pass \"late\": field \"f\" is declared inside the pass"));
}

TEST(BuilderErrors, OffsetsTooLarge) {
    for (const IVec2 offset : {IVec2{17, 0}, IVec2{0, -17}, IVec2{1000, 0}}) {
        const std::string error = errorOf([&](GeneratorBuilder& g) {
            const auto f = g.field<Float>("f");
            g.pass2D("first", [&](Pass& p) { p.set(f, Float(1.0f)); });
            g.pass2D("far", [&](Pass& p) { p.readAt(f, offset); });
            g.pass3D("fine", [](Pass&) {});
        });
        EXPECT_THAT(error, HasSubstr("pass \"far\": field \"f\": offset "));
        EXPECT_THAT(error, HasSubstr("beyond 16 blocks"));
    }
}

TEST(BuilderErrors, NoiseUsedTwiceWithDifferentParameters) {
    const std::vector<std::function<void(Pass&)>> seconds = {
        [](Pass& p) { p.perlin2D("n", 32, {1.0f}); },
        [](Pass& p) {
            p.perlin2D("n", 16, {1.0f, 2.0f});
        },
        [](Pass& p) { p.voronoi2D("n", 16, 1); },
        [](Pass& p) { p.perlin3D("n", 16, {1.0f}); },
    };
    for (const auto& second : seconds) {
        const std::string error = errorIn3D([&](Pass& p) {
            p.perlin2D("n", 16, {1.0f});
            p.perlin2D("n", 16, {1.0f});  // the same again is the same noise
            second(p);
        });
        EXPECT_EQ(error,
                  "generator \"test\": pass \"faulty\": noise \"n\" is used twice with different parameters");
    }
}

TEST(BuilderErrors, NoiseOfBadSize) {
    EXPECT_THAT(errorIn2D([](Pass& p) { p.perlin2D("n", 0, {1.0f}); }),
                HasSubstr("noise \"n\": size 0 is not in"));
    EXPECT_THAT(errorIn2D([](Pass& p) { p.perlin2D("n", -4, {1.0f}); }), HasSubstr("size -4"));
    EXPECT_THAT(errorIn2D([](Pass& p) { p.perlin2D("n", 65537, {1.0f}); }), HasSubstr("size 65537"));
    EXPECT_THAT(errorIn3D([](Pass& p) { p.perlin3D("n", 0, {1.0f}); }), HasSubstr("size 0"));
    EXPECT_THAT(errorIn2D([](Pass& p) { p.voronoi2D("n", 16385, 1); }), HasSubstr("at most 16384 blocks"));
}

TEST(BuilderErrors, NoiseOfBadOctavesOrPoints) {
    EXPECT_THAT(errorIn2D([](Pass& p) { p.perlin2D("n", 8, {}); }), HasSubstr("1 to 12 octave weights"));
    EXPECT_THAT(errorIn2D([](Pass& p) { p.perlin2D("n", 1, std::vector<float>(13, 1.0f)); }),
                HasSubstr("1 to 12 octave weights"));
    EXPECT_THAT(errorIn2D([](Pass& p) { p.perlin2D("n", 65536, std::vector<float>(6, 1.0f)); }),
                HasSubstr("the largest octave is beyond 2^20 blocks"));
    EXPECT_THAT(errorIn2D([](Pass& p) { p.voronoi2D("n", 8, 0); }), HasSubstr("0 points per cell"));
    EXPECT_EQ(errorIn2D([](Pass& p) { p.voronoi2D("n", 8, 5); }),
              "generator \"test\": pass \"faulty\": noise \"n\": 5 points per cell, expected 1 to 4");
}

TEST(BuilderErrors, WhatOnly3DPassesHave) {
    EXPECT_THAT(errorIn2D([](Pass& p) { p.z(); }), HasSubstr("pass \"faulty\": z: only in 3D passes"));
    EXPECT_THAT(errorIn2D([](Pass& p) { p.perlin3D("n", 8, {1.0f}); }),
                HasSubstr("perlin3D: only in 3D passes"));
    EXPECT_THAT(errorIn2D([](Pass& p) { p.blockHere(); }), HasSubstr("blockHere: only in 3D passes"));
    EXPECT_THAT(errorIn2D([](Pass& p) { p.setBlock(Block(1)); }), HasSubstr("setBlock: only in 3D passes"));
}

TEST(BuilderErrors, BlocksReadBeforeThereAreAny) {
    const std::string expected = "pass \"faulty\": blocks are read, but no earlier 3D pass sets them";
    EXPECT_THAT(errorIn2D([](Pass& p) { p.blockInColumn(3); }), HasSubstr(expected));
    EXPECT_THAT(errorIn3D([](Pass& p) { p.blockHere(); }), HasSubstr(expected));
    EXPECT_THAT(errorIn3D([](Pass& p) { p.blockInColumn(3); }), HasSubstr(expected));
}

TEST(BuilderErrors, TheLastPassMakesTheBlocks) {
    EXPECT_EQ(errorOf([](GeneratorBuilder&) {}), "generator \"test\": the last pass must be a 3D pass");
    EXPECT_EQ(errorOf([](GeneratorBuilder& g) {
                  g.pass3D("ground", [](Pass&) {});
                  g.pass2D("plants", [](Pass&) {});
              }),
              "generator \"test\": the last pass must be a 3D pass");
}

TEST(Builder, LimitsThatAreStillAllowed) {
    const GeneratorGraph g = build([](GeneratorBuilder& builder) {
        const auto f = builder.field<Float>("f");
        builder.pass2D("first", [&](Pass& p) {
            const Float large = p.perlin2D("large", 65536, {1, 2, 3, 4, 5}),
                        deep = p.perlin2D("deep", 1, std::vector<float>(12, 1.0f));
            p.set(f, large + deep + p.voronoi2D("cells", kMaxVoronoiSize, 4).distance);
        });
        builder.pass3D("last", [&](Pass& p) {
            p.setBlock(Block(Int(p.readAt(f, {16, -16}) + p.readAt(f, {-16, 16}))));
        });
    });
    EXPECT_EQ(g.passes.size(), 2u);
    EXPECT_EQ(g.passes[1].readsAt, std::vector<std::uint32_t>{0});
    EXPECT_EQ(g.fields[0].writtenBy, 0);
    EXPECT_EQ(g.noises.size(), 3u);
}

}  // namespace
}  // namespace terrane::gen
