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
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace terrane::gen {

enum class NoiseKind : std::uint8_t { Perlin2D, Perlin3D, Voronoi2D };

struct NoiseCall {
    NoiseKind kind = NoiseKind::Perlin2D;
    std::string name;            // names the seed: stable when code moves
    std::int32_t size = 1;       // blocks: smallest lattice (Perlin), cell (Voronoi); 1…65,536
    std::vector<float> weights;  // Perlin: of octaves size, 2 size, 4 size, …
    int maxPoints = 1;           // Voronoi: 1…4

    bool operator==(const NoiseCall&) const = default;
};

// Results of a Voronoi call.
enum VoronoiResult : std::uint32_t {
    kVoronoiDistance,  // Float, blocks, to the nearest point
    kVoronoiRatio,     // Float, 0…1, nearest / second nearest
    kVoronoiOffsetX,   // Int, blocks, from here to the nearest point
    kVoronoiOffsetY,
    kVoronoiResultCount
};

// Squared distances of candidates, at most (1.81 cells + two tile diagonals)², fit 31 bits.
constexpr std::int32_t kMaxVoronoiSize = 16384;

// What octave number `octave` adds to a call's seed: 2^32 / golden ratio, odd.
constexpr std::uint32_t octaveSeedStep(std::size_t octave) {
    return static_cast<std::uint32_t>(octave) * 0x9E3779B9u;
}

constexpr std::uint32_t resultCount(NoiseKind kind) {
    return kind == NoiseKind::Voronoi2D ? std::uint32_t{kVoronoiResultCount} : 1u;
}

}  // namespace terrane::gen
