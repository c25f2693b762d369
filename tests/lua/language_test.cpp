// Each word of the language records what its C++ counterpart does: the graphs are equal, node by node.
#include "terrane/gen/generators/trees/trees.h"
#include "terrane/gen/language/compounds.h"
#include "tests/lua/same_graph.h"

namespace terrane::lua {
namespace {

using namespace gen;

struct FloatCase {
    const char* text;
    Float (*cpp)(Pass&);
};

Vec2 v2(Pass& p) {
    const Float a = f(p);
    return {a, a * 2.0f};
}
Vec3 v3(Pass& p) {
    const Float a = f(p);
    return {a, a * 2.0f, a * 3.0f};
}
Float ofInt(Int i) {
    return Float(i);
}
Float ofBool(Bool b) {
    return select(b, Float(1.0f), Float(0.0f));
}

const FloatCase kCases[] = {
    {"f(p) + 1", [](Pass& p) { return f(p) + 1.0f; }},
    {"1 + f(p)", [](Pass& p) { return 1.0f + f(p); }},
    {"f(p) - 1.5", [](Pass& p) { return f(p) - 1.5f; }},
    {"2 - f(p)", [](Pass& p) { return 2.0f - f(p); }},
    {"f(p) * 3", [](Pass& p) { return f(p) * 3.0f; }},
    {"f(p) / 3", [](Pass& p) { return f(p) / 3.0f; }},
    {"-f(p)", [](Pass& p) { return -f(p); }},
    {"f(p) ^ 1.5", [](Pass& p) { return pow(f(p), 1.5f); }},
    {"pow(f(p), 2)", [](Pass& p) { return pow(f(p), 2.0f); }},
    {"float(p.x)", [](Pass& p) { return ofInt(p.x()); }},
    {"float(p.x + 5)", [](Pass& p) { return ofInt(p.x() + 5); }},
    {"float(7 - p.y)", [](Pass& p) { return ofInt(Int(7) - p.y()); }},
    {"float(p.x * -3)", [](Pass& p) { return ofInt(p.x() * -3); }},
    {"float(-p.x)", [](Pass& p) { return ofInt(-p.x()); }},
    {"float(p.x // 16)", [](Pass& p) { return ofInt(floorDivide(p.x(), 16)); }},
    {"float(p.x % 16)", [](Pass& p) { return ofInt(floorModulo(p.x(), 16)); }},
    {"float(floorDivide(p.x, 16))", [](Pass& p) { return ofInt(floorDivide(p.x(), 16)); }},
    {"float(floorModulo(p.x, 16))", [](Pass& p) { return ofInt(floorModulo(p.x(), 16)); }},
    {"float(p.x & 15)", [](Pass& p) { return ofInt(p.x() & 15); }},
    {"float(p.x | 15)", [](Pass& p) { return ofInt(p.x() | 15); }},
    {"float(p.x ~ 15)", [](Pass& p) { return ofInt(p.x() ^ 15); }},
    {"float(~p.x)", [](Pass& p) { return ofInt(p.x() ^ -1); }},
    {"float(p.x << 3)", [](Pass& p) { return ofInt(p.x() << 3); }},
    {"float(p.x >> 3)", [](Pass& p) { return ofInt(p.x() >> 3); }},
    {"float(min(p.x, 5))", [](Pass& p) { return ofInt(min(p.x(), 5)); }},
    {"float(max(p.x, 5))", [](Pass& p) { return ofInt(max(p.x(), 5)); }},
    {"float(abs(p.x))", [](Pass& p) { return ofInt(abs(p.x())); }},
    {"float(clamp(p.x, 0, 9))", [](Pass& p) { return ofInt(clamp(p.x(), 0, 9)); }},
    {"float(int(f(p)))", [](Pass& p) { return ofInt(Int(f(p))); }},
    {"float(floatBits(f(p)))", [](Pass& p) { return ofInt(floatBits(f(p))); }},
    {"bitsFloat(p.x)", [](Pass& p) { return bitsFloat(p.x()); }},
    {"float(packColor(f(p), 0.5, 1))", [](Pass& p) { return ofInt(packColor(f(p), 0.5f, 1.0f)); }},
    {"min(f(p), 0.5)", [](Pass& p) { return min(f(p), 0.5f); }},
    {"min(f(p), 0.5, 0.25)", [](Pass& p) { return min(min(f(p), 0.5f), 0.25f); }},
    {"max(f(p), 0.5)", [](Pass& p) { return max(f(p), 0.5f); }},
    {"clamp(f(p), 0.25, 0.5)", [](Pass& p) { return clamp(f(p), 0.25f, 0.5f); }},
    {"abs(f(p))", [](Pass& p) { return abs(f(p)); }},
    {"floor(f(p))", [](Pass& p) { return floor(f(p)); }},
    {"ceil(f(p))", [](Pass& p) { return ceil(f(p)); }},
    {"round(f(p))", [](Pass& p) { return round(f(p)); }},
    {"sqrt(f(p))", [](Pass& p) { return sqrt(f(p)); }},
    {"exp2(f(p))", [](Pass& p) { return exp2(f(p)); }},
    {"log2(f(p))", [](Pass& p) { return log2(f(p)); }},
    {"sin(f(p))", [](Pass& p) { return sin(f(p)); }},
    {"cos(f(p))", [](Pass& p) { return cos(f(p)); }},
    {"lerp(1, 3, f(p))", [](Pass& p) { return lerp(1.0f, 3.0f, f(p)); }},
    {"smoothstep(0, 0.5, f(p))", [](Pass& p) { return smoothstep(0.0f, 0.5f, f(p)); }},
    {"select(f(p):lt(0.5), 3, f(p))", [](Pass& p) { return select(f(p) < 0.5f, Float(3.0f), f(p)); }},
    {"multiSelect({{f(p):lt(0.5), 3}, {f(p):lt(0.75), 2.5}}, 4)",
     [](Pass& p) {
         const Bool first = f(p) < 0.5f, second = f(p) < 0.75f;
         const Float last = select(second, Float(2.5f), Float(4.0f));
         return select(first, Float(3.0f), last);
     }},
    {"ofBool(f(p):lt(0.5))", [](Pass& p) { return ofBool(f(p) < 0.5f); }},
    {"ofBool(f(p):le(0.5))", [](Pass& p) { return ofBool(f(p) <= 0.5f); }},
    {"ofBool(f(p):gt(0.5))", [](Pass& p) { return ofBool(f(p) > 0.5f); }},
    {"ofBool(f(p):ge(0.5))", [](Pass& p) { return ofBool(f(p) >= 0.5f); }},
    {"ofBool(f(p):eq(0.5))", [](Pass& p) { return ofBool(f(p) == 0.5f); }},
    {"ofBool(f(p):ne(0.5))", [](Pass& p) { return ofBool(f(p) != 0.5f); }},
    {"ofBool((3):lt(p.x))", [](Pass& p) { return ofBool(Int(3) < p.x()); }},
    {"ofBool(p.x:ge(-2) & p.y:lt(4))",
     [](Pass& p) {
         const Bool a = p.x() >= -2, b = p.y() < 4;
         return ofBool(a && b);
     }},
    {"ofBool(p.x:eq(2) | ~p.y:ne(4))",
     [](Pass& p) {
         const Bool a = p.x() == 2, b = !(p.y() != 4);
         return ofBool(a || b);
     }},
    {"ofBool(true & p.x:lt(1))", [](Pass& p) { return ofBool(Bool(true) && p.x() < 1); }},
    {"dot(v2(p), vec2(3, 4))",
     [](Pass& p) {
         return dot(v2(p), Vec2{3.0f, 4.0f});
     }},
    {"length(v2(p) + vec2(1, 2))",
     [](Pass& p) {
         return length(v2(p) + Vec2{1.0f, 2.0f});
     }},
    {"length(v2(p) - vec2(1, 2))",
     [](Pass& p) {
         return length(v2(p) - Vec2{1.0f, 2.0f});
     }},
    {"length(v2(p) * 3)", [](Pass& p) { return length(v2(p) * 3.0f); }},
    {"length(3 * v3(p))", [](Pass& p) { return length(Float(3.0f) * v3(p)); }},
    {"dot(-v3(p), v3(p))", [](Pass& p) { return dot(v3(p) * -1.0f, v3(p)); }},
    {"v3(p).z", [](Pass& p) { return v3(p).z; }},
    {"float((ivec2(p.x, 3) + ivec2(1, 2)).x)",
     [](Pass& p) {
         return ofInt((IVec2{p.x(), 3} + IVec2{1, 2}).x);
     }},
    {"p:perlin2D(\"n\", 16, {1, 0.5})",
     [](Pass& p) {
         return p.perlin2D("n", 16, {1.0f, 0.5f});
     }},
    {"p:perlin2DWithGrain(\"n\", 16, {1})", [](Pass& p) { return p.perlin2DWithGrain("n", 16, {1.0f}); }},
    {"p:simplex2D(\"n\", 16, {1})", [](Pass& p) { return p.simplex2D("n", 16, {1.0f}); }},
    {"p:perlin2DGradient(\"n\", 16, {1}).y", [](Pass& p) { return p.perlin2DGradient("n", 16, {1.0f}).y; }},
    {"p:grain(\"n\")", [](Pass& p) { return p.grain("n"); }},
    {"p:grain2D(\"n\").x", [](Pass& p) { return p.grain2D("n").x; }},
    {"p:stripes2D(\"n\", 16, vec2(0.6, 0.8)).sine",
     [](Pass& p) {
         return p.stripes2D("n", 16, {0.6f, 0.8f}).sine;
     }},
    {"p:voronoi2D(\"n\", 64, 2).ratio", [](Pass& p) { return p.voronoi2D("n", 64, 2).ratio; }},
    {"float(p:voronoi2D(\"n\", 64, 2).offset.y)",
     [](Pass& p) { return ofInt(p.voronoi2D("n", 64, 2).offset.y); }},
    {"ofBool(p:randomBool2D(\"n\", 0.25))",
     [](Pass& p) {
         const Int x = p.x(), y = p.y();
         return ofBool(p.randomBool2D("n", 0.25f, x, y));
     }},
    {"float(p:scatter(\"n\", 7, 4).hash)", [](Pass& p) { return ofInt(scatter(p, "n", 7, 4).hash); }},
    {"p:erode(\"n\", v2(p), 0.5, {size = 64, octaves = 2}).height",
     [](Pass& p) { return erode(p, "n", v2(p), 0.5f, {.size = 64, .octaves = 2}).height; }},
    {"lostDeviation({1, 2}, 8, 64) + f(p)",
     [](Pass& p) {
         return Float(lostDeviation({1.0f, 2.0f}, 8, 64)) + f(p);
     }},
    {"lostSlope({1, 2}, 8, 64) + f(p)",
     [](Pass& p) {
         return Float(lostSlope({1.0f, 2.0f}, 8, 64)) + f(p);
     }},
    {"shareLeft(48, 32) + f(p)", [](Pass& p) { return Float(shareLeft(48, 32)) + f(p); }},
};

TEST(Language, WordsRecordWhatCppDoes) {
    for (const FloatCase& c : kCases) {
        for (const int level : {0, 3}) {
            const auto cpp = [&](GeneratorBuilder& g) {
                const auto result = g.field<Float>("result");
                g.pass2D("land", [&](Pass& p) { p.set(result, c.cpp(p)); });
            };
            EXPECT_EQ(hashOfScript(std::string(kPreamble) + c.text + ") end)", level), hashOf(cpp, level))
                << c.text;
        }
    }
}

// Functions of numbers alone give what the machine of expressions gives, so no library of the system decides.
TEST(Language, LiteralsAreComputedAsExpressions) {
    const auto value = [](const char* text, Float expected) {
        const auto graph =
            recorded(fmt::format("g:pass3D(\"a\", function(p) assert({} == {}) p:setBlock(\"stone\") end)",
                                 text, static_cast<double>(asFloat(expected.bits))));
        EXPECT_TRUE(graph) << graph.error().message;
    };
    value("sin(1.5)", sin(1.5f));
    value("pow(2, 0.5)", pow(2.0f, 0.5f));
    value("exp2(0.3)", exp2(0.3f));
    value("sqrt(2)", sqrt(2.0f));
    value("lerp(1, 2, 0.1)", lerp(1.0f, 2.0f, 0.1f));
}

}  // namespace
}  // namespace terrane::lua
