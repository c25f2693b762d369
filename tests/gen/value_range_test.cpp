#include "terrane/gen/compile/value_range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "terrane/gen/noise/perlin_tile.h"
#include "tests/gen/noise_reference.h"
#include "tests/gen/random_graph.h"

namespace terrane::gen {
namespace {

// Values of a type: a few near each other, or anything.
std::vector<Bits> randomValues(Type type, std::mt19937& random) {
    std::vector<Bits> values(1 + random() % 4);
    for (Bits& v : values) v = randomBits(type, random);
    if (type == Type::Int && random() % 2 == 0) {
        for (Bits& v : values) v = values[0] + random() % 9;
    }
    return values;
}

ValueRange rangeOfAll(Type type, const std::vector<Bits>& values) {
    ValueRange range = rangeOf(type, values.front());
    for (const Bits value : values) range = unite(type, range, rangeOf(type, value));
    return range;
}

bool isIn(const ValueRange& range, Type type, Bits value) {
    if (type != Type::Float) return asInt(value) >= range.low && asInt(value) <= range.high;
    const float f = asFloat(value);
    return std::isnan(f) ? range.mayBeNaN : f >= range.lowF && f <= range.highF;
}

// The result for any arguments within the ranges lies in the result's range.
TEST(ValueRange, HoldsTheResultOfEveryOperation) {
    std::mt19937 random(7);
    int certain = 0;
    for (auto k = static_cast<int>(Op::AddF); k <= static_cast<int>(Op::Phi); ++k) {
        const OpRecord& r = record(static_cast<Op>(k));
        for (int round = 0; round < 3000; ++round) {
            const bool isChoice = r.op == Op::Select || r.op == Op::Phi;
            const Type type = isChoice ? static_cast<Type>(random() % 3) : r.result;
            std::vector<std::vector<Bits>> values;
            std::vector<ValueRange> ranges;
            for (std::size_t a = 0; a < r.argCount; ++a) {
                const Type argType = isChoice && a > 0 ? type : r.argTypes[a];
                values.push_back(randomValues(argType, random));
                ranges.push_back(rangeOfAll(argType, values.back()));
            }
            const ValueRange range = resultRange(r.op, type, ranges);
            if (type != Type::Float && isCertain(range)) ++certain;
            for (int n = 0; n < 8; ++n) {
                std::vector<Bits> args;
                for (const auto& v : values) args.push_back(v[random() % v.size()]);
                const Bits result = r.evaluate(args);
                ASSERT_TRUE(isIn(range, type, result)) << r.name << ", round " << round << ": " << result;
            }
        }
    }
    EXPECT_GT(certain, 5000) << "ranges that always say \"anything\" are of no use";
}

TEST(ValueRange, RootsOfWhatMayBeZeroAreKnown) {
    const ValueRange fromZero[] = {floatRange(0, 16)}, below[] = {floatRange(-1, 16)};
    const ValueRange root = resultRange(Op::SqrtF, Type::Float, fromZero);
    EXPECT_NEAR(root.lowF, 0, 0.001);
    EXPECT_NEAR(root.highF, 4, 0.001);
    EXPECT_FALSE(root.mayBeNaN);
    EXPECT_TRUE(resultRange(Op::SqrtF, Type::Float, below).mayBeNaN);
}

TEST(ValueRange, SumsThatMayWrapAreUnknown) {
    const ValueRange sum[] = {intRange(0, std::numeric_limits<std::int32_t>::max()), intRange(0, 1)};
    EXPECT_EQ(resultRange(Op::AddI, Type::Int, sum).low, std::numeric_limits<std::int32_t>::min());
}

TEST(ValueRange, ComparisonsWithNaNAreNeverCertainlyTrue) {
    ValueRange maybe = floatRange(1, 2);
    maybe.mayBeNaN = true;
    const ValueRange args[] = {maybe, floatRange(5, 6)};
    EXPECT_FALSE(isCertain(resultRange(Op::LessF, Type::Bool, args)));
    const ValueRange never[] = {floatRange(5, 6), maybe};
    EXPECT_EQ(resultRange(Op::LessF, Type::Bool, never).high, 0);
    EXPECT_TRUE(isCertain(resultRange(Op::LessF, Type::Bool, never)));
}

TEST(ValueRange, BoundsPerlinNoise) {
    const NoiseCall call{NoiseKind::Perlin3D, "n", 8, {1.0f, -0.5f}};
    const ValueRange range = perlin3DRange(call);
    EXPECT_EQ(range.lowF, -range.highF);
    std::mt19937 random(3);
    const auto coordinate = [&] { return static_cast<std::int64_t>(random() % 4096); };
    float most = 0;
    for (int k = 0; k < 20000; ++k) {
        const std::array<std::int64_t, 3> block = {coordinate(), coordinate(), coordinate()};
        most =
            std::max(most, std::abs(reference::perlin3D(call, static_cast<std::uint32_t>(random()), block)));
    }
    EXPECT_LE(most, range.highF);
    EXPECT_GT(most, 0.25f * range.highF) << "or the bound is no use";
    EXPECT_FALSE(range.mayBeNaN);
}

}  // namespace
}  // namespace terrane::gen
