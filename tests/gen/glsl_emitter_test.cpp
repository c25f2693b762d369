// The text that the emitter writes, without a GL driver: names are declared once and seen only where they
// are. What the shaders compute is tested in tests/gen_gpu.
#include "terrane/gen/compile/glsl_emitter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/gen/gen_fixture.h"
#include "tests/gen/random_graph.h"

namespace terrane::gen {
namespace {

using testing::HasSubstr;
using testing::Not;

// Follows the scopes of a shader that is written one statement a line.
class ScopeCheck {
  public:
    void line(const std::string& text) {
        if (text.find('}') != std::string::npos) close();
        static const std::regex kName("\\b(v|next)[0-9]+\\b"),
            kDeclaration("(bool|int|float|vec2|Voronoi3?) ((v|next)[0-9]+)\\b");
        std::smatch declared;
        const bool declares = std::regex_search(text, declared, kDeclaration);
        const std::string own = declares ? declared[2].str() : "";
        for (auto it = std::sregex_iterator(text.begin(), text.end(), kName); it != std::sregex_iterator();
             ++it) {
            ASSERT_TRUE(it->str() == own || isVisible(it->str())) << text;
        }
        if (declares) {
            ASSERT_TRUE(everDeclared_.insert(own).second) << "twice: " << text;
            scopes_.back().insert(own);
        }
        if (text.find('{') != std::string::npos) scopes_.emplace_back();
    }

    std::size_t openScopes() const { return scopes_.size() - 1; }

  private:
    void close() {
        ASSERT_GT(scopes_.size(), 1u);
        scopes_.pop_back();
    }
    bool isVisible(const std::string& name) const {
        for (const auto& scope : scopes_) {
            if (scope.contains(name)) return true;
        }
        return false;
    }

    std::vector<std::set<std::string>> scopes_{1};
    std::set<std::string> everDeclared_;
};

TEST(GlslEmitterRandom, NamesAreDeclaredOnceAndSeenWhereTheyAre) {
    for (std::uint32_t seed = 0; seed < kRandomCases; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        std::istringstream text(emitGlsl(RandomGraph(seed, seed % 2 == 0).take(), 0));
        ScopeCheck check;
        for (std::string line; std::getline(text, line);) ASSERT_NO_FATAL_FAILURE(check.line(line)) << line;
        EXPECT_EQ(check.openScopes(), 0u);
    }
}

std::string emitted(const std::function<void(Pass&)>& pass) {
    return emitGlsl(build([&](GeneratorBuilder& g) { g.pass3D("pass", pass); }), 0);
}

// Compilers would round a decimal fraction differently.
TEST(GlslEmitter, FloatsAreWrittenAsBits) {
    const std::string text = emitted([](Pass& p) { p.setBlock(Block(Int(Float(p.z()) * 0.1f))); });
    EXPECT_THAT(text, HasSubstr("uintBitsToFloat(0x3dcccccdu)"));
    EXPECT_THAT(text, HasSubstr("precise float"));
}

TEST(GlslEmitter, WhatIsFreeOfZStandsBeforeTheLoopOverLayers) {
    const std::string text = emitted([](Pass& p) { p.setBlock(Block((p.x() * 7) & p.z())); });
    const auto product = text.find("columnX * 7"), loop = text.find("for (int z");
    const auto bits = text.find(" & ");
    ASSERT_NE(product, std::string::npos) << text;
    ASSERT_NE(loop, std::string::npos) << text;
    ASSERT_NE(bits, std::string::npos) << text;
    EXPECT_LT(product, loop);
    EXPECT_LT(loop, bits);
}

TEST(GlslEmitter, NegativeNumbersAndTheSmallestOne) {
    const std::string text =
        emitted([](Pass& p) { p.setBlock(Block(max(p.z() * -3, Int(-2147483647 - 1)))); });
    EXPECT_THAT(text, HasSubstr("int(0xfffffffdu)"));
    EXPECT_THAT(text, HasSubstr("int(0x80000000u)"));
}

TEST(GlslEmitter, ABranchIsABranch) {
    const std::string text = emitted([](Pass& p) {
        Var<Int> v = p.var(Int(0));
        p.if_(p.z() < 9, [&] { v = Int(p.perlin3D("inside", 8, {1.0f}) * 9.0f); });
        p.setBlock(Block(static_cast<Int>(v)));
    });
    const auto branch = text.find("if ("), noise = text.find("perlin3D("), otherwise = text.find("} else {");
    ASSERT_NE(branch, std::string::npos) << text;
    EXPECT_LT(branch, noise);
    EXPECT_LT(noise, otherwise);
}

TEST(GlslEmitter, StampsFindTheirFeetFirst) {
    const GeneratorGraph graph = build([](GeneratorBuilder& g) {
        const auto shape = g.field<Int>("shape"), base = g.field<Int>("base");
        g.shape({"post", {{"stone", 1}}, {{0, 0, 0, 0}}});
        g.pass2D("feet", [&](Pass& p) {
            p.set(shape, Int(0));
            p.set(base, Int(9));
        });
        g.pass3D("stamps", [&](Pass& p) { p.setBlock(p.stamp(shape, base)); });
    });
    const std::string text = emitGlsl(graph, 1);
    EXPECT_THAT(text,
                HasSubstr("beginTile();\n    beginStamps();\n    findFeet(0u, 0u, 1u);\n    endStamps();\n"));
    EXPECT_THAT(text, HasSubstr("= stampAt(0u, z);"));
    EXPECT_THAT(emitGlsl(graph, 0), Not(HasSubstr("Stamps")));
}

}  // namespace
}  // namespace terrane::gen
