// Random expressions: as text, and as C++ records them with the same numbers.
#include <random>

#include "tests/lua/same_graph.h"

namespace terrane::lua {
namespace {

using namespace gen;

// A random expression as text and as C++ records it, from left to right.
class RandomExpression {
  public:
    explicit RandomExpression(unsigned seed) : random_(seed) {}

    std::string floatText(int depth) {
        if (depth == 0) return pick({"f(p)", "float(p.y)", "p:perlin2D(\"n\", 16, {1})"});
        const int kind = number(6);
        if (kind == 4) {
            const std::string condition = boolText(depth - 1), a = floatText(depth - 1), b = literal();
            return fmt::format("select({}, {}, {})", condition, a, b);
        }
        const std::string a = floatText(depth - 1);
        if (kind == 3) return fmt::format("sqrt({})", a);
        const std::string b = kind == 1 ? literal() : floatText(depth - 1);
        if (kind == 2) return fmt::format("min({}, {})", a, b);
        return fmt::format("({} {} {})", a, kind == 0 ? "+" : kind == 1 ? "*" : "-", b);
    }
    std::string boolText(int depth) {
        if (depth == 0 || number(2) == 0) {
            const std::string a = floatText(depth), b = literal();
            return fmt::format("({}):lt({})", a, b);
        }
        const std::string a = boolText(depth - 1);
        const bool isAnd = number(2) == 0;
        const std::string b = boolText(depth - 1);
        return fmt::format("({} {} {})", a, isAnd ? "&" : "|", b);
    }

    // The same calls with the same seed record the same.
    Float floatOf(Pass& p, int depth) {
        if (depth == 0) {
            switch (number(3)) {
                case 0:
                    return f(p);
                case 1:
                    return Float(p.y());
                default:
                    return p.perlin2D("n", 16, {1.0f});
            }
        }
        switch (number(6)) {
            case 0: {
                const Float a = floatOf(p, depth - 1), b = floatOf(p, depth - 1);
                return a + b;
            }
            case 1: {
                const Float a = floatOf(p, depth - 1);
                return a * literalValue();
            }
            case 2: {
                const Float a = floatOf(p, depth - 1), b = floatOf(p, depth - 1);
                return min(a, b);
            }
            case 3:
                return sqrt(floatOf(p, depth - 1));
            case 4: {
                const Bool c = boolOf(p, depth - 1);
                const Float a = floatOf(p, depth - 1);
                return select(c, a, Float(literalValue()));
            }
            default: {
                const Float a = floatOf(p, depth - 1), b = floatOf(p, depth - 1);
                return a - b;
            }
        }
    }
    Bool boolOf(Pass& p, int depth) {
        if (depth == 0 || number(2) == 0) {
            const Float a = floatOf(p, depth);
            return a < literalValue();
        }
        const Bool a = boolOf(p, depth - 1);
        const bool isAnd = number(2) == 0;
        const Bool b = boolOf(p, depth - 1);
        return isAnd ? a && b : a || b;
    }

  private:
    int number(int below) { return static_cast<int>(random_() % static_cast<unsigned>(below)); }
    int literalNumber() { return number(40) - 20; }
    std::string literal() { return fmt::format("({} / 8)", literalNumber()); }
    float literalValue() { return static_cast<float>(literalNumber()) / 8.0f; }
    std::string pick(std::initializer_list<const char*> texts) {
        return texts.begin()[number(static_cast<int>(texts.size()))];
    }
    std::mt19937 random_;
};

TEST(RandomExpressions, RecordWhatCppDoes) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        const int depth = 2 + static_cast<int>(seed % 4);
        RandomExpression asText(seed);
        const std::string text = std::string(kPreamble) + asText.floatText(depth) + ") end)";
        const auto cpp = [&](GeneratorBuilder& g) {
            const auto result = g.field<Float>("result");
            g.pass2D("land", [&](Pass& p) { p.set(result, RandomExpression(seed).floatOf(p, depth)); });
        };
        EXPECT_EQ(hashOfScript(text, 0), hashOf(cpp, 0)) << seed << "\n" << text;
    }
}

}  // namespace
}  // namespace terrane::lua
