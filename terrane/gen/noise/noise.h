// Descriptions of noise calls, shared by the builder, the executor and the tests' references.
//
// Perlin (improved; K. Perlin, Improving Noise, 2002). Octave o has a lattice of `size << o` blocks and the
// weight weights[o]; the result is the sum of noise · weight, each noise in about -1…1 and 0 at the lattice
// nodes.
//   2D: 16 gradients of length √2 at (k + ½)·22.5°, so that the range is -1…1
//   3D: the 12 vectors to the edges of a cube
// Order of operations, the same on every back end: f = blocks from the lower node · (1 / size), f − 1 from
// the upper one; blend along x, then z (3D), then y, with lerp(a, b, t) = a + t(b − a) and t = f³(f(6f − 15)
// + 10); the linear function of the other offsets is blended as its coefficients; then the octaves are added
// in order.
//
// Voronoi (S. Worley, A Cellular Texture Basis Function, 1996). Cells of `size` blocks hold 1…maxPoints
// points at block positions; distances are Euclidean, in blocks, from the integer squared distance. The
// search covers 5×5 cells, which always holds the nearest and second nearest point: with a point in each cell
// these lie within 1.81 cells.
//   3D: the same in cubes; distances are (|x|^p + |y|^p + |z|^p)^(1/p), p the exponent: with larger ones
//   cells become boxes. The call gives the sums of powers, in cells (d = |blocks| · (1 / size), d·d·…·d from
//   the left, x and y added before z).
//
// Simplex, 2D (K. Perlin, Noise Hardware, 2001; S. Gustavson, Simplex noise demystified, 2005), in about
// -1…1. `size` is the edge of the skewed lattice's cells before skewing. A corner at the offset o, in cells,
// with the gradient g (those of Perlin noise) adds max(0, ½ − |o|²)⁴ · (o · g); ½ is where the next simplex
// begins, so that there is no step. The lattice is skewed by F = 15/41, which differs from (√3 − 1)/2 by
// 0.05 %: with a rational factor it repeats exactly after 41 cells, so that positions count from there, and
// it is as exact at 2^31 as at 0. simplex_tile.h states the order of operations.
//
// Stripes, 2D: waves across a direction that the caller gives, see stripe_tile.h.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace terrane::gen {

// The gradients of the first quadrant in 2D: x = kQuadrant[k], y = kQuadrant[3 − k], which are √2·(cos, sin)
// of (k + ½)·22.5°. The other quadrants are these, turned by right angles. gen_gpu/noise.glsl has their bits.
constexpr float kQuadrant[4] = {1.38703990f, 1.17587554f, 0.785694957f, 0.275899380f};

enum class NoiseKind : std::uint8_t {
    Perlin2D,
    Perlin3D,
    Voronoi2D,
    Voronoi3D,
    Simplex2D,
    Stripes2D,
    Drainage,
    Valleys
};

struct NoiseCall {
    NoiseKind kind = NoiseKind::Perlin2D;
    std::string name;  // names the seed: stable when code moves
    // Blocks: width of the smallest lattice, 1…65,536; Voronoi: width of a cell, 1…kMaxVoronoiSize. Drainage
    // and valleys: number of the map.
    std::int32_t size = 1;
    std::vector<float> weights;  // Perlin, simplex: of octaves size, 2 size, 4 size, …
    int maxPoints = 1;           // Voronoi: 1…4
    int exponent = 2;            // Voronoi 3D: of the metric, 2…8

    bool operator==(const NoiseCall&) const = default;
};

// Returns the share of its amplitude that noise with cells of `size` blocks has at `step` blocks between
// samples. Cells smaller than two steps would only flicker, so they fade: 1 for cells of two steps or more, 0
// for one step or less. Always 1 at step 1.
float shareLeft(std::int32_t size, std::int32_t step);
// Returns the octave weights, each multiplied by its shareLeft().
std::vector<float> fadedWeights(std::vector<float> weights, std::int32_t size, std::int32_t step);

// Returns the standard deviation of the part of 2D Perlin noise that fades between step 1 and `step`: of its
// value, and of its slope per block along an axis as Pass::slope measures it at both steps. 0 at step 1.
float lostDeviation(const std::vector<float>& weights, std::int32_t size, std::int32_t step);
float lostSlope(const std::vector<float>& weights, std::int32_t size, std::int32_t step);

// Returns half the distance over which Pass::slope measures, in blocks. At step 1 a distance of two blocks
// would count each single step of the ground in full.
constexpr std::int32_t slopeReach(std::int32_t step) {
    return step == 1 ? 2 : step;
}

// Results of a Voronoi call.
enum VoronoiResult : std::uint32_t {
    kVoronoiDistance,  // Float, blocks, to the nearest point
    kVoronoiRatio,     // Float, 0…1, nearest / second nearest
    kVoronoiOffsetX,   // Int, blocks, from here to the nearest point
    kVoronoiOffsetY,
    kVoronoiResultCount
};

// Results of a call in 3D.
enum Voronoi3DResult : std::uint32_t {
    kVoronoi3DNearest,  // Float: sum of powers of the offset to the nearest point, in cells
    kVoronoi3DSecond,   // Float: to the second nearest
    kVoronoi3DOffsetX,  // Int, blocks, from here to the nearest point
    kVoronoi3DOffsetY,
    kVoronoi3DOffsetZ,
    kVoronoi3DResultCount
};

// Results of stripes, each in -1…1: cos and sin of the phase.
enum StripeResult : std::uint32_t { kStripeCos, kStripeSin, kStripeResultCount };
// Results of a drainage call, all Float: those of DrainageSample in its order (drainage.h).
constexpr std::uint32_t kDrainageResultCount = 7;
constexpr std::uint32_t kValleysResultCount = 3;  // likewise, those of ValleySample

// Squared distances of candidates, at most (1.81 cells + two tile diagonals)², fit 31 bits.
constexpr std::int32_t kMaxVoronoiSize = 16384;

// These return the names that seeds are derived from, with the world's seed: noise and random numbers of one
// name differ.
inline std::string noiseSeedName(std::string_view name) {
    return "noise " + std::string(name);
}
inline std::string randomSeedName(std::string_view name) {
    return "random " + std::string(name);
}

// Returns the number that is added to a call's seed for octave `octave`: that number times 2^32 / golden
// ratio, which is rounded to odd.
constexpr std::uint32_t octaveSeedStep(std::size_t octave) {
    return static_cast<std::uint32_t>(octave) * 0x9E3779B9u;
}

constexpr std::uint32_t resultCount(NoiseKind kind) {
    if (kind == NoiseKind::Voronoi2D) return kVoronoiResultCount;
    if (kind == NoiseKind::Stripes2D) return kStripeResultCount;
    if (kind == NoiseKind::Drainage) return kDrainageResultCount;
    if (kind == NoiseKind::Valleys) return kValleysResultCount;
    return kind == NoiseKind::Voronoi3D ? std::uint32_t{kVoronoi3DResultCount} : 1u;
}

constexpr bool readsDrainage(NoiseKind kind) {
    return kind == NoiseKind::Drainage || kind == NoiseKind::Valleys;
}

constexpr bool is3D(NoiseKind kind) {
    return kind == NoiseKind::Perlin3D || kind == NoiseKind::Voronoi3D;
}

// One octave of a Perlin or simplex call. Octaves of weight 0 are left out.
struct Octave {
    std::int32_t size;
    std::uint32_t seedStep;
    float weight;
};
std::vector<Octave> octavesOf(const NoiseCall& call);
bool hasOctaves(const NoiseCall& call);

}  // namespace terrane::gen
