#include "terrane/shared/det_math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "tests/gen/pass_runner.h"
#include "tests/gen/worst_error.h"

namespace terrane::gen {
namespace {

using shared::detDivide;
using shared::detInverseSqrt;
using shared::detReciprocal;
using shared::detSqrt;

constexpr int kSamples = 1'000'000;

// Known answers, found by the compiler: they would not compile where a step is not a constant expression.
static_assert(detDivide(6.0f, 3.0f) == 2.0f);
static_assert(detDivide(1.0f, 3.0f) == 1.0f / 3.0f);
static_assert(detDivide(-7.0f, 2.0f) == -3.5f);
static_assert(detDivide(7.0f, -2.0f) == -3.5f);
static_assert(detDivide(0.0f, 5.0f) == 0.0f);
static_assert(detDivide(1.0f, 0x1p125f) == 0x1p-125f);
static_assert(detDivide(1.0f, 0x1p-126f) == 0x1p126f);
static_assert(detSqrt(4.0f) == 2.0f);
static_assert(detSqrt(2.0f) == 1.41421354f);
static_assert(detSqrt(0x1p-100f) == 0x1p-50f);
static_assert(detSqrt(0.0f) == 0.0f);
static_assert(detInverseSqrt(4.0f) > 0.499997f && detInverseSqrt(4.0f) < 0.500003f);

// Uniform in sign and mantissa, the exponent uniform in [lowest, highest].
float randomFloat(std::mt19937_64& random, int lowest, int highest) {
    const std::uint64_t r = random();
    const auto span = static_cast<std::uint64_t>(highest - lowest + 1);
    const auto exponent =
        static_cast<std::uint32_t>(static_cast<std::uint64_t>(lowest + 127) + (r >> 40) % span);
    return std::bit_cast<float>((static_cast<std::uint32_t>(r) & 0x807FFFFFu) | exponent << 23);
}

// Distance in units in the last place of `exact` as a float.
double errorUlp(float value, double exact) {
    int exponent = 0;
    std::frexp(exact, &exponent);
    const int unit = std::max(exponent - 24, -149);
    return std::abs(double{value} - exact) / std::ldexp(1.0, unit);
}

TEST(DetMath, InverseRootsAreWithinFiveMillionths) {
    std::mt19937_64 random(4);
    double worst = 0;
    for (int k = 0; k < kSamples; ++k) {
        const float x = std::abs(randomFloat(random, -100, 100));
        worst = std::max(worst, std::abs(double{detInverseSqrt(x)} * std::sqrt(double{x}) - 1));
    }
    EXPECT_LT(worst, 5e-6);
}

TEST(DetMath, DivisionIsWithinTwoUnitsInTheLastPlace) {
    std::mt19937_64 random(1);
    double worst = 0;
    int tested = 0;
    while (tested < kSamples) {
        const float a = randomFloat(random, -126, 126), b = randomFloat(random, -126, 124);
        const double exact = double{a} / double{b};
        if (std::abs(exact) < 0x1p-126 || std::abs(exact) > 0x1.fp127) continue;
        raise(worst, errorUlp(detDivide(a, b), exact));
        ++tested;
    }
    EXPECT_LE(worst, 1.4);
    RecordProperty("worst_ulp_thousandths", static_cast<int>(worst * 1000));
}

TEST(DetMath, ReciprocalIsWithinTwoUnitsInTheLastPlace) {
    std::mt19937_64 random(2);
    double worst = 0;
    for (int k = 0; k < kSamples; ++k) {
        const float x = std::abs(randomFloat(random, -126, 124));
        raise(worst, errorUlp(detReciprocal(x), 1.0 / double{x}));
    }
    EXPECT_LE(worst, 2.0);
}

TEST(DetMath, SquareRootIsWithinOneUnitInTheLastPlace) {
    std::mt19937_64 random(3);
    double worst = 0;
    for (int k = 0; k < kSamples; ++k) {
        const float x = std::abs(randomFloat(random, -126, 127));
        raise(worst, errorUlp(detSqrt(x), std::sqrt(double{x})));
    }
    EXPECT_LE(worst, 0.77);
}

// Distances to blocks straight along an axis come out whole.
TEST(DetMath, RootsOfSquaresAreExact) {
    for (int k = 0; k <= 4096; ++k) {
        const auto root = static_cast<float>(k);
        ASSERT_EQ(detSqrt(root * root), root);
    }
}

TEST(DetMath, DivisionByPowersOfTwoIsExact) {
    std::mt19937_64 random(6);
    for (int exponent = -60; exponent <= 60; ++exponent) {
        for (int k = 0; k < 100; ++k) {
            const float a = randomFloat(random, -60, 60);
            ASSERT_EQ(detDivide(a, std::ldexp(1.0f, exponent)), std::ldexp(a, -exponent));
        }
    }
}

// 19 · 127 / 19 is a unit below 127: code that rounds a quotient must allow for that.
TEST(DetMath, WholeQuotientsAreWithinOneUnit) {
    for (int b = 1; b <= 64; ++b) {
        for (int q = -200; q <= 200; ++q) {
            const float quotient = detDivide(static_cast<float>(q * b), static_cast<float>(b));
            ASSERT_LE(errorUlp(quotient, q), 1.0) << q << " · " << b;
        }
    }
    EXPECT_NE(detDivide(19.0f * 127.0f, 19.0f), 127.0f);
}

TEST(DetMath, SignsMoveThroughADivision) {
    std::mt19937_64 random(4);
    for (int k = 0; k < 10000; ++k) {
        const float a = randomFloat(random, -60, 60), b = randomFloat(random, -60, 60);
        const float q = detDivide(a, b);
        ASSERT_EQ(detDivide(-a, b), -q);
        ASSERT_EQ(detDivide(a, -b), -q);
        ASSERT_EQ(detDivide(-a, -b), q);
    }
}

// Every operand that a pass can meet: also zeros, infinities, NaN and denormal numbers.
std::vector<Bits> hardFloats() {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    std::vector<Bits> values;
    for (const float v : {0.0f, 1.0f, 3.0f, 0x1p-149f, 0x1p-127f, 0x1p-126f, 0x1p125f, 0x1p126f,
                          0x1.fffffep127f, kInfinity, std::numeric_limits<float>::quiet_NaN()}) {
        values.push_back(bitsOf(v));
        values.push_back(bitsOf(-v));
    }
    return values;
}

// Columns of a, b, a / b and √a by the kernels of the chosen instruction set.
class KernelMath {
  public:
    KernelMath()
        : runner_([](GeneratorBuilder& g) {
              const auto a = g.field<Float>("a"), b = g.field<Float>("b");
              const auto quotient = g.field<Float>("quotient"), root = g.field<Float>("root");
              g.pass2D("arguments", [&](Pass& p) {
                  p.set(a, Float(0.0f));
                  p.set(b, Float(0.0f));
              });
              g.pass2D("math", [&](Pass& p) {
                  p.set(quotient, p.read(a) / p.read(b));
                  p.set(root, sqrt(p.read(a)));
              });
          }) {}

    void compare(const ColumnValues& a, const ColumnValues& b) {
        runner_.fields = {a, b};
        const std::vector<ColumnValues> results = runner_.run2D(1);
        for (std::size_t lane = 0; lane < a.size(); ++lane) {
            const Bits quotient = bitsOf(detDivide(asFloat(a[lane]), asFloat(b[lane])));
            const Bits root = bitsOf(detSqrt(asFloat(a[lane])));
            ASSERT_TRUE(sameFloat(results[0][lane], quotient))
                << asFloat(a[lane]) << " / " << asFloat(b[lane]);
            ASSERT_TRUE(sameFloat(results[1][lane], root)) << "√" << asFloat(a[lane]);
        }
    }

  private:
    PassRunner runner_;
};

TEST(DetMath, EveryInstructionSetGivesTheSameBits) {
    onEachTarget([] {
        std::mt19937_64 random(5);
        KernelMath math;
        ColumnValues a, b;
        for (int k = 0; k < 400; ++k) {  // 400 · 256 pairs
            for (std::size_t lane = 0; lane < a.size(); ++lane) {
                a[lane] = static_cast<Bits>(random());  // any bits, NaN and denormal numbers too
                b[lane] = k % 2 ? static_cast<Bits>(random()) : bitsOf(randomFloat(random, -126, 124));
            }
            ASSERT_NO_FATAL_FAILURE(math.compare(a, b));
        }
    });
}

TEST(DetMath, EveryInstructionSetGivesTheSameBitsForHardOperands) {
    const std::vector<Bits> hard = hardFloats();
    onEachTarget([&] {
        KernelMath math;
        ColumnValues a, b;
        for (std::size_t first = 0; first < hard.size() * hard.size(); first += a.size()) {
            for (std::size_t lane = 0; lane < a.size(); ++lane) {
                const std::size_t pair = (first + lane) % (hard.size() * hard.size());
                a[lane] = hard[pair % hard.size()];
                b[lane] = hard[pair / hard.size()];
            }
            ASSERT_NO_FATAL_FAILURE(math.compare(a, b));
        }
    });
}

}  // namespace
}  // namespace terrane::gen
