// Small generators against plain C++ that computes the same for each voxel.
#include "terrane/gen/language/builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "terrane/shared/det_math.h"
#include "tests/gen/gen_fixture.h"

namespace terrane::gen {
namespace {

using shared::detDivide;
using shared::detSqrt;

using std::int32_t;
using std::int64_t;

// An expression, and its expected value at (x, y, z).
struct Case {
    const char* name;
    std::function<Int(Int x, Int y, Int z)> write;
    ExpectedBlock expected;
};

void check(const std::vector<Case>& cases) {
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        expectNumbers([&](Pass& p) { return c.write(p.x(), p.y(), p.z()); }, c.expected);
        if (testing::Test::HasFatalFailure()) return;
    }
}

TEST(BuilderNumbers, IntArithmetic) {
    check({
        {"sum", [](Int x, Int y, Int z) { return x + y * 3 + z; },
         [](int64_t x, int64_t y, int64_t z) { return wrapped(x + y * 3 + z); }},
        {"difference", [](Int x, Int y, Int z) { return 5 - x - (y - z); },
         [](int64_t x, int64_t y, int64_t z) { return wrapped(5 - x - (y - z)); }},
        {"product", [](Int x, Int y, Int z) { return (x * y * (z + 1)) >> 8; },
         [](int64_t x, int64_t y, int64_t z) { return wrapped(int64_t{wrapped(x * y)} * (z + 1)) >> 8; }},
        {"negative", [](Int x, Int, Int z) { return -x + -z; },
         [](int64_t x, int64_t, int64_t z) { return wrapped(-x - z); }},
        {"smallest and largest", [](Int x, Int y, Int z) { return min(x, y - z) - max(x + z, y); },
         [](int64_t x, int64_t y, int64_t z) {
             const int32_t low = std::min(wrapped(x), wrapped(y - z)),
                           high = std::max(wrapped(x + z), wrapped(y));
             return wrapped(int64_t{low} - high);
         }},
        {"magnitude", [](Int x, Int y, Int z) { return abs(x + z) + abs(y - z); },
         [](int64_t x, int64_t y, int64_t z) {
             return wrapped(std::abs(int64_t{wrapped(x + z)}) + std::abs(int64_t{wrapped(y - z)}));
         }},
        {"bits", [](Int x, Int y, Int z) { return (x & 0x5A5A) + ((y >> 3) & (z * 5)); },
         [](int64_t x, int64_t y, int64_t z) { return wrapped((x & 0x5A5A) + ((y >> 3) & (z * 5))); }},
        {"shift by a varying count", [](Int x, Int, Int z) { return x >> (z & 15); },
         [](int64_t x, int64_t, int64_t z) { return wrapped(x >> (z & 15)); }},
        {"clamp", [](Int x, Int, Int z) { return clamp(x - 3, 0 - z, z); },
         [](int64_t x, int64_t, int64_t z) {
             return wrapped(std::min(std::max(int64_t{wrapped(x - 3)}, -z), z));
         }},
    });
}

// Bit k of the block is the k-th answer.
Int bits(const std::vector<Bool>& answers) {
    Int sum = 0;
    for (std::size_t k = 0; k < answers.size(); ++k) sum = sum + select(answers[k], Int(1 << k), Int(0));
    return sum;
}
int32_t bits(const std::vector<bool>& answers) {
    int32_t sum = 0;
    for (std::size_t k = 0; k < answers.size(); ++k) sum += answers[k] ? 1 << k : 0;
    return sum;
}

TEST(BuilderNumbers, ComparisonsAndLogic) {
    check({
        {"integers",
         [](Int x, Int y, Int z) {
             const Int a = x & 7, b = z & 7;
             return bits({a<b, a <= b, a> b, a >= b, a == b, a != b, y == y, x < x});
         },
         [](int32_t x, int32_t, int32_t z) {
             const int32_t a = x & 7, b = z & 7;
             return bits(std::vector<bool>{a<b, a <= b, a> b, a >= b, a == b, a != b, true, false});
         }},
        {"floats",
         [](Int x, Int, Int z) {
             const Float a = Float(x & 7) * 0.5f, b = Float(z & 7) * 0.5f;
             return bits({a<b, a <= b, a> b, a >= b, a == b, a != b});
         },
         [](int32_t x, int32_t, int32_t z) {
             const int32_t a = x & 7, b = z & 7;
             return bits(std::vector<bool>{a<b, a <= b, a> b, a >= b, a == b, a != b});
         }},
        {"logic",
         [](Int x, Int y, Int z) {
             const Bool a = (x & 1) == 1, b = (y & 2) == 2, c = z > 100;
             return bits({a && b, a || c, !a, !(a && !c) || b, a && Bool(true), b || Bool(true)});
         },
         [](int32_t x, int32_t y, int32_t z) {
             const bool a = (x & 1) == 1, b = (y & 2) == 2, c = z > 100;
             return bits(std::vector<bool>{a && b, a || c, !a, !(a && !c) || b, a, true});
         }},
    });
}

// Small floats from coordinates: exact whatever the place.
float small(int32_t v) {
    return static_cast<float>(v & 63) * 0.37f - 9.0f;
}
Float small(Int v) {
    return Float(v & 63) * 0.37f - 9.0f;
}
// Ten bits of the fraction.
int32_t scaled(float v) {
    return static_cast<int32_t>(v * 1024.0f);
}
Int scaled(Float v) {
    return Int(v * 1024.0f);
}

TEST(BuilderNumbers, FloatArithmetic) {
    check({
        {"sum, difference, product",
         [](Int x, Int y, Int z) { return scaled(small(x) * small(y) + small(z) - small(x + z)); },
         [](int32_t x, int32_t y, int32_t z) {
             return scaled(small(x) * small(y) + small(z) - small(wrapped(int64_t{x} + z)));
         }},
        {"quotient",
         [](Int x, Int y, Int z) { return scaled(small(x) / (small(y) + small(z) * 0.01f + 30.0f)); },
         [](int32_t x, int32_t y, int32_t z) {
             return scaled(detDivide(small(x), small(y) + small(z) * 0.01f + 30.0f));
         }},
        {"rounding",
         [](Int x, Int y, Int z) {
             return scaled(floor(small(x)) + ceil(small(y)) * 64.0f + round(small(z)) * 0.5f);
         },
         [](int32_t x, int32_t y, int32_t z) {
             return scaled(std::floor(small(x)) + std::ceil(small(y)) * 64.0f +
                           std::floor(small(z) + 0.5f) * 0.5f);
         }},
        {"smallest and largest",
         [](Int x, Int y, Int z) { return scaled(min(small(x), small(y)) * 8.0f + max(small(y), small(z))); },
         [](int32_t x, int32_t y, int32_t z) {
             return scaled(std::min(small(x), small(y)) * 8.0f + std::max(small(y), small(z)));
         }},
        {"magnitude and clamp",
         [](Int x, Int y, Int) { return scaled(abs(small(x)) - clamp(small(y), -1.5f, 2.25f)); },
         [](int32_t x, int32_t y, int32_t) {
             return scaled(std::abs(small(x)) - std::clamp(small(y), -1.5f, 2.25f));
         }},
        {"conversion", [](Int x, Int, Int z) { return Int(Float(z) * -0.75f) + Int(small(x)); },
         [](int32_t x, int32_t, int32_t z) {
             return static_cast<int32_t>(static_cast<float>(z) * -0.75f) + static_cast<int32_t>(small(x));
         }},
    });
}

TEST(BuilderNumbers, FloatFunctions) {
    check({
        {"root", [](Int x, Int y, Int z) { return scaled(sqrt(abs(small(x) * small(y))) + sqrt(Float(z))); },
         [](int32_t x, int32_t y, int32_t z) {
             return scaled(detSqrt(std::abs(small(x) * small(y))) + detSqrt(static_cast<float>(z)));
         }},
        {"length",
         [](Int x, Int, Int z) {
             return scaled(length({small(x), small(z)}));
         },
         [](int32_t x, int32_t, int32_t z) {
             return scaled(detSqrt(small(x) * small(x) + small(z) * small(z)));
         }},
        {"blend", [](Int x, Int y, Int z) { return scaled(lerp(small(x), small(y), Float(z) * 0.01f)); },
         [](int32_t x, int32_t y, int32_t z) {
             return scaled(small(x) + static_cast<float>(z) * 0.01f * (small(y) - small(x)));
         }},
        {"smoothstep",
         [](Int x, Int, Int z) { return scaled(smoothstep(-4.0f, small(z) + 20.0f, small(x))); },
         [](int32_t x, int32_t, int32_t z) {
             const float width = small(z) + 20.0f - -4.0f;
             const float t = std::min(std::max(detDivide(small(x) - -4.0f, width), 0.0f), 1.0f);
             return scaled(t * t * (3.0f - 2.0f * t));
         }},
        {"choice",
         [](Int x, Int y, Int z) { return scaled(select(small(x) < small(z), small(y), Float(7.5f))); },
         [](int32_t x, int32_t y, int32_t z) { return scaled(small(x) < small(z) ? small(y) : 7.5f); }},
    });
}

TEST(BuilderBlocks, NamesAreIdsOfTheRegistry) {
    expectBlocks(
        [](GeneratorBuilder& g) {
            g.pass3D("ground", [](Pass& p) {
                const Block above = select(p.z() <= 80, p.block("water"), p.block("air"));
                p.setBlock(select(p.z() < 60, select(p.z() == 59, p.block("dirt"), p.block("stone")), above));
            });
        },
        [](int32_t, int32_t, int32_t z) {
            if (z < 60) return z == 59 ? 2 : 1;
            return z <= 80 ? 3 : 0;
        });
}

TEST(BuilderBlocks, APassThatSetsNothingLeavesAir) {
    expectBlocks([](GeneratorBuilder& g) { g.pass3D("nothing", [](Pass&) {}); },
                 [](int32_t, int32_t, int32_t) { return 0; });
}

TEST(BuilderBlocks, TheLastBlockSetCounts) {
    expectBlocks(
        [](GeneratorBuilder& g) {
            g.pass3D("twice", [](Pass& p) {
                p.setBlock(p.block("stone"));
                p.if_(p.z() > 7, [&] { p.setBlock(p.block("dirt")); });
            });
        },
        [](int32_t, int32_t, int32_t z) { return z > 7 ? 2 : 1; });
}

}  // namespace
}  // namespace terrane::gen
