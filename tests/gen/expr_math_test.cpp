// Accuracy of the functions that are written in the language itself, and their bits on every instruction set.
#include "terrane/gen/language/expr.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "tests/gen/pass_runner.h"
#include "tests/gen/worst_error.h"

namespace terrane::gen {
namespace {

using Function = Float (*)(Float);

float folded(Function f, float x) {
    return asFloat(f(Float(x)).bits);
}
float foldedPow(float x, float y) {
    return asFloat(pow(Float(x), Float(y)).bits);
}

double ulp(double v) {
    return std::ldexp(1.0, std::ilogb(v) - 23);
}

constexpr int kPoints = 200000;

template <class Use>
void forRandom(float low, float high, Use use) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> value(low, high);
    for (int k = 0; k < kPoints; ++k) use(value(random));
}

TEST(ExprMath, Exp2) {
    double worst = 0;
    forRandom(-126.0f, 127.9f, [&](float x) {
        const double exact = std::exp2(double{x});
        raise(worst, std::abs(folded(exp2, x) - exact) / ulp(exact));
    });
    RecordProperty("worst_ulp", std::to_string(worst));
    EXPECT_LT(worst, 1.5);
    for (int n = -126; n <= 127; ++n) {
        EXPECT_EQ(folded(exp2, static_cast<float>(n)), std::ldexp(1.0f, n)) << n;
    }
}

TEST(ExprMath, Exp2BeyondItsRange) {
    EXPECT_EQ(folded(exp2, -126.5f), 0.0f);
    EXPECT_EQ(folded(exp2, -1e30f), 0.0f);
    EXPECT_GT(folded(exp2, 1e30f), 3.4e38f);
    EXPECT_TRUE(std::isfinite(folded(exp2, 1e30f)));
    EXPECT_EQ(folded(exp2, std::numeric_limits<float>::quiet_NaN()), 0.0f);
}

TEST(ExprMath, Log2) {
    double worst = 0;
    const auto check = [&](float x) {
        const double exact = std::log2(double{x});
        raise(worst, std::abs(folded(log2, x) - exact) / ulp(std::max(std::abs(exact), 0.125)));
    };
    forRandom(0.5f, 2.0f, check);
    forRandom(-126.0f, 127.0f, [&](float e) { check(std::exp2(e)); });
    RecordProperty("worst_ulp", std::to_string(worst));
    EXPECT_LT(worst, 2.5);
    for (int n = -126; n <= 127; ++n) EXPECT_EQ(folded(log2, std::ldexp(1.0f, n)), static_cast<float>(n));
}

TEST(ExprMath, Log2OfWhatHasNone) {
    EXPECT_EQ(folded(log2, 0.0f), -1e9f);
    EXPECT_EQ(folded(log2, -3.0f), -1e9f);
    EXPECT_EQ(folded(exp2, folded(log2, 0.0f)), 0.0f);
}

TEST(ExprMath, Pow) {
    double worst = 0;
    forRandom(0.001f, 50.0f, [&](float x) {
        for (const float y : {0.5f, 0.85f, 2.0f, -1.5f, 7.3f}) {
            const double exact = std::pow(double{x}, double{y}), exponent = y * std::log2(double{x});
            const double relative = std::abs(foldedPow(x, y) - exact) / exact;
            raise(worst, relative / (std::ldexp(2.0 + std::abs(exponent), -23)));
        }
    });
    RecordProperty("worst_share_of_the_bound", std::to_string(worst));
    EXPECT_LT(worst, 1.0);
    EXPECT_EQ(foldedPow(0.0f, 0.85f), 0.0f);
    EXPECT_EQ(foldedPow(-4.0f, 2.0f), 0.0f);
    EXPECT_EQ(foldedPow(0.0f, 0.0f), 1.0f);
    EXPECT_EQ(foldedPow(4.0f, 0.5f), 2.0f);
}

TEST(ExprMath, SinAndCos) {
    for (const float range : {3.2f, 100.0f, 10000.0f}) {
        double worst = 0;
        forRandom(-range, range, [&](float x) {
            raise(worst, std::abs(folded(sin, x) - std::sin(double{x})));
            raise(worst, std::abs(folded(cos, x) - std::cos(double{x})));
        });
        RecordProperty("worst", std::to_string(worst * 0x1p23));
        EXPECT_LT(worst, 0x1p-23) << range;
    }
    EXPECT_EQ(folded(sin, 0.0f), 0.0f);
    EXPECT_EQ(folded(cos, 0.0f), 1.0f);
}

// Angles far beyond what is accurate, infinities, NaN: whatever comes out comes out everywhere.
TEST(ExprMath, EveryInstructionSetGivesTheSameBits) {
    const std::vector<Function> functions = {exp2, log2, sin, cos};
    PassRunner runner([&](GeneratorBuilder& g) {
        const auto in = g.field<Float>("in"), power = g.field<Float>("power");
        std::vector<Field<Float>> out;
        for (std::size_t k = 0; k < functions.size(); ++k) {
            out.push_back(g.field<Float>("out" + std::to_string(k)));
        }
        g.pass2D("in", [&](Pass& p) { p.set(in, Float(0.0f)); });
        g.pass2D("functions", [&](Pass& p) {
            for (std::size_t k = 0; k < functions.size(); ++k) p.set(out[k], functions[k](p.read(in)));
            p.set(power, pow(p.read(in), Float(1.7f)));
        });
    });
    std::mt19937 random(3);
    for (int round = 0; round < 20; ++round) {
        for (Bits& v : runner.fields[0])
            v = round % 2 == 0 ? random() : bitsOf(random() % 40000 * 0.01f - 200.0f);
        onEachTarget([&] {
            const std::vector<ColumnValues> results = runner.run2D(1);
            for (std::size_t lane = 0; lane < kTileLanes; ++lane) {
                const float x = asFloat(runner.fields[0][lane]);
                ASSERT_TRUE(sameFloat(results[0][lane], bitsOf(foldedPow(x, 1.7f)))) << x;
                for (std::size_t k = 0; k < functions.size(); ++k) {
                    ASSERT_TRUE(sameFloat(results[k + 1][lane], bitsOf(folded(functions[k], x))))
                        << k << " " << x;
                }
            }
        });
    }
}

}  // namespace
}  // namespace terrane::gen
