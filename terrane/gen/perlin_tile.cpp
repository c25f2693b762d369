#include "terrane/gen/perlin_tile.h"

#include <cassert>

#include "terrane/shared/hash.h"

namespace terrane::gen {
namespace {

using shared::uint;

struct Gradient2 {
    float x, y;
};

// √2·(cos, sin) of (k + ½)·22.5°.
constexpr float kG0 = 1.38703990f, kG1 = 1.17587554f, kG2 = 0.785694957f, kG3 = 0.275899380f;
constexpr Gradient2 kGradients2[16] = {
    {kG0, kG3},  {kG1, kG2},  {kG2, kG1},   {kG3, kG0},   {-kG3, kG0},  {-kG2, kG1},
    {-kG1, kG2}, {-kG0, kG3}, {-kG0, -kG3}, {-kG1, -kG2}, {-kG2, -kG1}, {-kG3, -kG0},
    {kG3, -kG0}, {kG2, -kG1}, {kG1, -kG2},  {kG0, -kG3},
};

struct Gradient3 {
    float x, y, z;
};

constexpr Gradient3 kGradients3[12] = {
    {1, 1, 0},  {-1, 1, 0},  {1, -1, 0}, {-1, -1, 0}, {1, 0, 1},  {-1, 0, 1},
    {1, 0, -1}, {-1, 0, -1}, {0, 1, 1},  {0, -1, 1},  {0, 1, -1}, {0, -1, -1},
};

// Nodes count modulo 2^32: the one behind the last block of the world is the one before the first.
Gradient2 gradient2(uint x, uint y, std::uint32_t seed) {
    return kGradients2[shared::hash2(x, y, seed) >> 28];
}

Gradient3 gradient3(uint x, uint y, uint z, std::uint32_t seed) {
    const uint h = shared::hash3(x, y, z, seed);
    return kGradients3[((h >> 16) * 12u) >> 16];
}

float fade(float f) {
    return ((f * f) * f) * (f * (f * 6.0f - 15.0f) + 10.0f);
}

float lerp(float a, float b, float t) {
    return a + t * (b - a);
}

// Cells and fractions of the coordinates of 16 columns in a row.
struct AxisCells {
    std::array<uint, kTileSize> cell;
    TileRow offset, fadeOf;
};

AxisCells axisCells(std::int32_t first, std::int32_t step, std::int32_t size, float inverseSize) {
    assert(size >= step && "from one column to the next at most one cell ends");
    AxisCells axis{};
    // The start of a cell may lie before the first block of the world: no int32 holds it.
    const bool isBelow = first % size < 0;
    uint cell = static_cast<uint>(first / size) - (isBelow ? 1u : 0u);
    std::int32_t rest = isBelow ? first % size + size : first % size;
    for (std::size_t k = 0; k < kTileSize; ++k) {
        axis.cell[k] = cell;
        axis.offset[k] = static_cast<float>(rest) * inverseSize;
        rest += step;
        cell += rest >= size ? 1u : 0u;
        rest -= rest >= size ? size : 0;
    }
    // Loops of their own become SIMD instructions.
    for (std::size_t k = 0; k < kTileSize; ++k) axis.fadeOf[k] = fade(axis.offset[k]);
    return axis;
}

int setRows(PerlinOctave& octave, const AxisCells& y) {
    for (std::size_t r = 0; r < kTileSize; ++r) {
        octave.rows.node[r] = static_cast<std::uint8_t>(y.cell[r] - y.cell[0]);
    }
    octave.rows.offset = y.offset;
    octave.rows.fade = y.fadeOf;
    octave.nodeRows = octave.rows.node[kTileSize - 1] + 2;
    assert(octave.nodeRows <= kMaxNodeRows && "a tile spans at most 16 cells");
    return octave.nodeRows;
}

// The gradients left and right of each x, looked up once a cell.
template <class Lookup, class Use>
void forEachX(const std::array<uint, kTileSize>& cells, Lookup lookup, Use useAt) {
    auto left = lookup(cells[0]);
    auto right = lookup(cells[0] + 1);
    for (std::size_t k = 0; k < kTileSize; ++k) {
        if (k > 0 && cells[k] != cells[k - 1]) {
            left = right;
            right = lookup(cells[k] + 1);
        }
        useAt(k, left, right);
    }
}

void fillLevel(const Perlin3DTile::Octave& o, std::int32_t zCell, PerlinLevel& level) {
    for (uint row = 0; row < static_cast<uint>(o.layer.nodeRows); ++row) {
        const auto lookup = [&](uint cell) {
            return gradient3(cell, o.yCell + row, static_cast<uint>(zCell), o.seed);
        };
        TileRow leftX, leftY, leftZ, rightX, rightY, rightZ;
        forEachX(o.xCell, lookup, [&](std::size_t k, Gradient3 left, Gradient3 right) {
            leftX[k] = left.x, leftY[k] = left.y, leftZ[k] = left.z;
            rightX[k] = right.x, rightY[k] = right.y, rightZ[k] = right.z;
        });
        TileRow &one = level.one[row], &y = level.y[row], &z = level.z[row];
        for (std::size_t k = 0; k < kTileSize; ++k) {
            const float f = o.xOffset[k], t = o.xFade[k];
            one[k] = lerp(leftX[k] * f, rightX[k] * (f - 1.0f), t);
            y[k] = lerp(leftY[k], rightY[k], t);
            z[k] = lerp(leftZ[k], rightZ[k], t);
        }
    }
}

}  // namespace

void prepare(Perlin2DTile& tile, const NoiseCall& call, std::uint32_t seed, SampleGrid grid) {
    const std::vector<Octave> octaves = octavesOf(call);
    tile.octaves.resize(octaves.size());
    for (std::size_t o = 0; o < octaves.size(); ++o) {
        PerlinOctave& octave = tile.octaves[o];
        const std::int32_t size = octaves[o].size;
        const float inverseSize = 1.0f / static_cast<float>(size);
        const AxisCells x = axisCells(grid.x, grid.step, size, inverseSize);
        const AxisCells y = axisCells(grid.y, grid.step, size, inverseSize);
        octave.weight = octaves[o].weight;
        const auto nodeRows = static_cast<uint>(setRows(octave, y));
        for (uint row = 0; row < nodeRows; ++row) {
            const auto lookup = [&](uint cell) {
                return gradient2(cell, y.cell[0] + row, seed + octaves[o].seedStep);
            };
            TileRow leftX, leftY, rightX, rightY;
            forEachX(x.cell, lookup, [&](std::size_t k, Gradient2 left, Gradient2 right) {
                leftX[k] = left.x, leftY[k] = left.y;
                rightX[k] = right.x, rightY[k] = right.y;
            });
            TileRow &a = octave.a[row], &b = octave.b[row];
            for (std::size_t k = 0; k < kTileSize; ++k) {
                const float f = x.offset[k], t = x.fadeOf[k];
                a[k] = lerp(leftX[k] * f, rightX[k] * (f - 1.0f), t);
                b[k] = lerp(leftY[k], rightY[k], t);
            }
        }
    }
}

void prepare(Perlin3DTile& tile, const NoiseCall& call, std::uint32_t seed, SampleGrid grid) {
    const std::vector<Octave> octaves = octavesOf(call);
    tile.octaves.resize(octaves.size());
    tile.layer = -1;
    for (std::size_t n = 0; n < octaves.size(); ++n) {
        Perlin3DTile::Octave& o = tile.octaves[n];
        o.size = octaves[n].size;
        o.inverseSize = 1.0f / static_cast<float>(o.size);
        o.seed = seed + octaves[n].seedStep;
        const AxisCells x = axisCells(grid.x, grid.step, o.size, o.inverseSize);
        const AxisCells y = axisCells(grid.y, grid.step, o.size, o.inverseSize);
        o.xCell = x.cell;
        o.xOffset = x.offset;
        o.xFade = x.fadeOf;
        o.yCell = y.cell[0];
        o.layer.weight = octaves[n].weight;
        setRows(o.layer, y);
    }
}

void moveToCellsOf(Perlin3DTile& tile, std::int32_t z) {
    assert(z >= 0 && "layers count from the bottom of the world");
    const bool first = tile.layer < 0;
    for (Perlin3DTile::Octave& o : tile.octaves) {
        const std::int32_t zCell = z / o.size;
        if (first || (zCell != o.zCell && zCell != o.zCell + 1)) {
            fillLevel(o, zCell, o.levels[0]);
            fillLevel(o, zCell + 1, o.levels[1]);
        } else if (zCell == o.zCell + 1) {
            o.levels[0] = o.levels[1];
            fillLevel(o, zCell + 1, o.levels[1]);
        }
        o.zCell = zCell;
        o.zOffset = static_cast<float>(z - zCell * o.size) * o.inverseSize;
        o.zFade = fade(o.zOffset);
    }
    tile.layer = z;
}

}  // namespace terrane::gen
