// Noise written as expressions of the generator language: both back ends compute the same bits without code
// of their own. Slower than the kinds of noise.h, which have kernels.
#pragma once

#include <array>
#include <functional>
#include <span>

#include "terrane/gen/language/expr.h"
#include "terrane/gen/noise/noise.h"

namespace terrane::gen {

// A hash of lattice coordinates (2 or 3) with an octave's seed.
using LatticeHash = std::function<Int(std::span<const Int> node)>;

// Returns the gradient of the Perlin noise of noise.h per block, by axis; 0 along axes that `position` lacks.
// `position`: block coordinates, 2 or 3.
std::array<Float, 3> perlinGradient(std::span<const Int> position, std::int32_t size,
                                    const LatticeHash& hash);

// Returns simplex noise in 3D (K. Perlin, Noise Hardware, 2001; S. Gustavson, Simplex noise demystified,
// 2005) in about -1…1. `size` is the edge of the skewed lattice's cells before skewing, in blocks. A corner
// at the offset o, in cells, with the gradient g adds max(0, ½ − |o|²)⁴ · (o · g); ½ is where the next
// simplex begins, so that there is no step. Gradients: the 12 edges of a cube, as for Perlin noise. Noise in
// 2D has a kernel: noise.h.
//
// The lattice is skewed by 1/3, so that it repeats exactly after 3 cells and positions count from there: it
// is as exact at 2^31 as at 0.
Float simplex3D(Int x, Int y, Int z, std::int32_t size, const LatticeHash& hash);

}  // namespace terrane::gen
