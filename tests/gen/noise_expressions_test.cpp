// Noise that is written in the language: against slow references in double precision, and what makes it
// noise.
#include "terrane/gen/language/pass_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "tests/gen/noise_reference.h"
#include "tests/gen/pass_runner.h"

namespace terrane::gen {
namespace {

using Position = std::array<std::int64_t, 3>;

constexpr std::array<Position, 7> kFarPlaces = {{{0, 0, 0},
                                                 {-1, -1, 255},
                                                 {123456, -98765, 77},
                                                 {-2147483648LL, -2147483648LL, 3},
                                                 {2147483600, 2147483600, 200},
                                                 {-2147483648LL, 2147483600, 100},
                                                 {1LL << 24, -(1LL << 30), 31}}};

// Simplex noise by its definition: corners of the simplex in order of the offsets, everything in doubles.
double simplexReference(const Position& block, std::size_t dimensions, std::int64_t size,
                        std::uint32_t seed) {
    const double skew = dimensions == 2 ? 15.0 / 41.0 : 1.0 / 3.0;
    const double unskew = dimensions == 2 ? 15.0 / 71.0 : 1.0 / 6.0;
    std::array<double, 3> p{}, o{};
    Position cell{};
    double sum = 0, cells = 0;
    for (std::size_t k = 0; k < dimensions; ++k) {
        p[k] = static_cast<double>(block[k]) / static_cast<double>(size);
        sum += p[k];
    }
    for (std::size_t k = 0; k < dimensions; ++k) {
        cell[k] = static_cast<std::int64_t>(std::floor(p[k] + sum * skew + 1e-12));
        cells += static_cast<double>(cell[k]);
    }
    for (std::size_t k = 0; k < dimensions; ++k) o[k] = p[k] - static_cast<double>(cell[k]) + cells * unskew;
    std::vector<std::size_t> order(dimensions);
    for (std::size_t k = 0; k < dimensions; ++k) order[k] = k;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return o[a] > o[b]; });
    double noise = 0;
    for (std::size_t corner = 0; corner <= dimensions; ++corner) {
        double t = 0.5, ramp = 0;
        std::array<float, 3> g{};
        if (dimensions == 2) {
            const auto flat = reference::gradient2(cell[0], cell[1], seed);
            g = {flat[0], flat[1], 0};
        } else {
            g = reference::gradient3(cell, seed);
        }
        for (std::size_t k = 0; k < dimensions; ++k) {
            t -= o[k] * o[k];
            ramp += o[k] * double{g[k]};
        }
        if (t > 0) noise += t * t * t * t * ramp;
        if (corner == dimensions) break;
        // Along the next axis, then back where that leads in unskewed space.
        cell[order[corner]] += 1;
        o[order[corner]] -= 1;
        for (std::size_t k = 0; k < dimensions; ++k) o[k] += unskew;
    }
    return noise * (dimensions == 2 ? 70.3 : 76.8);
}

// In 2D the reference of the kernels: random graphs compare the kernels with it to the bit.
float simplexAt(const Position& block, std::size_t dimensions, std::int32_t size, std::uint32_t seed) {
    const auto coordinate = [&](std::size_t k) { return Int(static_cast<std::int32_t>(block[k])); };
    const LatticeHash hash = [seed](std::span<const Int> node) {
        return Int(asInt(shared::hash3(node[0].bits, node[1].bits, node[2].bits, seed)));
    };
    if (dimensions == 2) return reference::simplexOctave(size, seed, block[0], block[1]);
    return asFloat(simplex3D(coordinate(0), coordinate(1), coordinate(2), size, hash).bits);
}

class Simplex : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, Simplex, testing::Values(2u, 3u));

TEST_P(Simplex, EverySampleIsThatOfTheDefinition) {
    for (const std::int32_t size : {1, 7, 16, 300}) {
        for (const Position& place : kFarPlaces) {
            for (std::int64_t k = 0; k < 40; ++k) {
                const Position at = {place[0] + k % 7, place[1] + k % 11,
                                     std::min<std::int64_t>(255, place[2] + k)};
                ASSERT_NEAR(simplexAt(at, GetParam(), size, 99), simplexReference(at, GetParam(), size, 99),
                            2e-4)
                    << size << " at " << at[0] << " " << at[1] << " " << at[2];
            }
        }
    }
}

TEST_P(Simplex, FillsMinusOneToOneAndGoesOnSmoothly) {
    constexpr std::int32_t kSize = 24;
    float low = 0, high = 0, step = 0;
    for (std::int64_t row = 0; row < 40; ++row) {
        float before = simplexAt({-2000, row * 37, row * 6}, GetParam(), kSize, 5);
        for (std::int64_t x = -1999; x < 1000; ++x) {
            const float v = simplexAt({x, row * 37, row * 6}, GetParam(), kSize, 5);
            low = std::min(low, v);
            high = std::max(high, v);
            step = std::max(step, std::abs(v - before));
            before = v;
        }
    }
    EXPECT_GE(low, -1.0f);
    EXPECT_LE(high, 1.0f);
    EXPECT_LT(low, -0.75f);
    EXPECT_GT(high, 0.75f);
    EXPECT_LT(step, 7.5f / kSize) << "no step where one simplex ends and the next begins";
}

TEST_P(Simplex, DifferentSeedsHaveNothingInCommon) {
    double product = 0, squares = 0;
    for (std::int64_t k = 0; k < 4000; ++k) {
        const Position at = {k * 13, k * 7, k % 256};
        const double a = simplexAt(at, GetParam(), 9, 1), b = simplexAt(at, GetParam(), 9, 2);
        product += a * b;
        squares += (a * a + b * b) / 2;
    }
    EXPECT_LT(std::abs(product / squares), 0.05);
}

// Anisotropy of a noise: the power spectrum of many patches by angle, summed over a ring of wavelengths
// around the lattice's; standard deviation over mean.
template <class Sample>
double anisotropy(Sample sample) {
    constexpr int kPatch = 48, kDirections = 16;
    constexpr double kLow = 1.5, kHigh = 2.0;  // cycles a lattice cell
    constexpr double kSize = 8;
    std::array<double, kDirections> power{};
    for (int direction = 0; direction < kDirections; ++direction) {
        const double angle = (direction + 0.5) * std::numbers::pi / kDirections;
        for (double f = kLow; f < kHigh; f += 0.1) {
            const double fx = std::cos(angle) * f / kSize, fy = std::sin(angle) * f / kSize;
            for (int patch = 0; patch < 12; ++patch) {
                std::complex<double> sum = 0;
                for (int y = 0; y < kPatch; ++y) {
                    for (int x = 0; x < kPatch; ++x) {
                        const double window = std::pow(std::sin((x + 0.5) * std::numbers::pi / kPatch) *
                                                           std::sin((y + 0.5) * std::numbers::pi / kPatch),
                                                       2);
                        sum += window * sample(patch, x, y) *
                               std::polar(1.0, -2 * std::numbers::pi * (fx * x + fy * y));
                    }
                }
                power[static_cast<std::size_t>(direction)] += std::norm(sum);
            }
        }
    }
    double mean = 0, variance = 0;
    for (const double p : power) mean += p / kDirections;
    for (const double p : power) variance += (p - mean) * (p - mean) / kDirections;
    return std::sqrt(variance) / mean;
}

TEST(SimplexSpectrum, IsSpreadMoreEvenlyThanPerlins) {
    constexpr int kPatches = 12, kPatch = 48;
    std::vector<float> simplex, perlin;
    const NoiseCall call = {NoiseKind::Perlin2D, "p", 8, {1.0f}};
    for (int patch = 0; patch < kPatches; ++patch) {
        for (int y = 0; y < kPatch; ++y) {
            for (int x = 0; x < kPatch; ++x) {
                simplex.push_back(simplexAt({x + patch * 1000, y, 0}, 2, 8, 3));
                perlin.push_back(reference::perlin2D(call, 3, x + patch * 1000, y));
            }
        }
    }
    const auto of = [](const std::vector<float>& values) {
        return [&values](int patch, int x, int y) {
            return double{values[static_cast<std::size_t>((patch * kPatch + y) * kPatch + x)]};
        };
    };
    const double ofSimplex = anisotropy(of(simplex)), ofPerlin = anisotropy(of(perlin));
    RecordProperty("simplex", std::to_string(ofSimplex));
    RecordProperty("perlin", std::to_string(ofPerlin));
    EXPECT_LT(ofSimplex, 0.5 * ofPerlin) << ofSimplex << " and " << ofPerlin;
}

// Gradients against differences of the noise itself over a lattice so wide that two blocks are next to
// nothing.
TEST(PerlinGradient, IsTheChangeABlock) {
    constexpr std::int32_t kSize = 512;
    const NoiseCall flat = {NoiseKind::Perlin2D, "p", kSize, {1.0f}};
    const NoiseCall solid = {NoiseKind::Perlin3D, "p", kSize, {1.0f}};
    for (const Position& place : kFarPlaces) {
        for (std::int64_t k = 0; k < 60; ++k) {
            const Position at = {place[0] + 17 * k + 1, place[1] + 29 * k + 1, 1 + (place[2] + 3 * k) % 250};
            const auto slope = [&](std::size_t dimensions) {
                std::vector<Int> position;
                for (std::size_t n = 0; n < dimensions; ++n) {
                    position.push_back(Int(static_cast<std::int32_t>(static_cast<std::uint64_t>(at[n]))));
                }
                return perlinGradient(position, kSize, [](std::span<const Int> node) {
                    const Bits x = node[0].bits, y = node[1].bits;
                    return Int(asInt(node.size() == 2 ? shared::hash2(x, y, 4)
                                                      : shared::hash3(x, y, node[2].bits, 4)));
                });
            };
            const auto slope2 = slope(2), slope3 = slope(3);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                Position before = at, after = at;
                before[axis] -= 1;
                after[axis] += 1;
                if (after[0] > 2147483647 || after[1] > 2147483647) continue;
                const float d3 = reference::perlin3D(solid, 4, after) - reference::perlin3D(solid, 4, before);
                ASSERT_NEAR(asFloat(slope3[axis].bits), d3 / 2, 2e-6) << axis;
                if (axis == 2) continue;
                const float d2 = reference::perlin2D(flat, 4, after[0], after[1]) -
                                 reference::perlin2D(flat, 4, before[0], before[1]);
                ASSERT_NEAR(asFloat(slope2[axis].bits), d2 / 2, 2e-6) << axis;
            }
        }
    }
}

// The calls of a pass take the seeds of their names and octaves, as the noise does whose gradient they give.
TEST(PerlinGradient, OfAPassBelongsToTheNoiseOfItsName) {
    const std::vector<float> weights = {0.5f, 0.0f, 2.0f};
    const GeneratorGraph graph = build([&](GeneratorBuilder& g) {
        const auto value = g.field<Float>("value"), slope = g.field<Float>("slope");
        g.pass2D("noise", [&](Pass& p) {
            p.set(value, p.perlin2D("hills", 100, weights));
            p.set(slope, p.perlin2DGradient("hills", 100, weights).x);
        });
        g.pass3D("last", [](Pass&) {});
    });
    const Seeds seeds = makeSeeds(graph, 77);
    ASSERT_EQ(seeds.hashes.size(), 1u);
    EXPECT_EQ(seeds.hashes[0], seeds.noises[0]);
    PassRunner runner(graph);
    runner.seeds = seeds;
    const std::vector<ColumnValues> results = runner.run2D(0);
    for (std::size_t lane = 1; lane < 15; ++lane) {
        const float difference = asFloat(results[0][lane + 1]) - asFloat(results[0][lane - 1]);
        EXPECT_NEAR(asFloat(results[1][lane]), difference / 2, 2e-4);
    }
}

}  // namespace
}  // namespace terrane::gen
