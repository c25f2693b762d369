#include "terrane/gen/noise/perlin_tile.h"

#include <cassert>

#include "terrane/shared/language.h"

namespace terrane::gen {
namespace {

using shared::uint;

float fade(float f) {
    return ((f * f) * f) * (f * (f * 6.0f - 15.0f) + 10.0f);
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

// Nodes count modulo 2^32: the one behind the last block of the world is the one before the first.
void fillLevel(const Perlin3DTile::Octave& o, std::int32_t zCell, PerlinLevel& level) {
    for (uint row = 0; row < static_cast<uint>(o.layer.nodeRows); ++row) {
        fillNodeRow3D(o.x, {o.yCell + row, static_cast<uint>(zCell)}, o.seed,
                      {level.one[row], level.y[row], level.z[row]});
    }
}

}  // namespace

void prepare(Perlin2DTile& tile, const NoiseCall& call, std::uint32_t seed, SampleGrid grid) {
    const std::vector<Octave> octaves = octavesOf(call);
    tile.octaves.resize(octaves.size());
    for (std::size_t o = 0; o < octaves.size(); ++o) {
        PerlinOctave& octave = tile.octaves[o];
        const std::int32_t size = octaves[o].size;
        const AxisCells x = axisCells(grid.x, grid.step, size);
        const AxisCells y = axisCells(grid.y, grid.step, size);
        octave.weight = octaves[o].weight;
        const auto nodeRows = static_cast<uint>(setRows(octave, y));
        for (uint row = 0; row < nodeRows; ++row) {
            fillNodeRow2D(x, y.cell[0] + row, seed + octaves[o].seedStep, octave.a[row], octave.b[row]);
        }
    }
}

void prepare(Perlin3DTile& tile, const NoiseCall& call, std::uint32_t seed, SampleGrid grid) {
    const std::vector<Octave> octaves = octavesOf(call);
    tile.octaves.resize(octaves.size());
    tile.layer = kNoLayer;
    for (std::size_t n = 0; n < octaves.size(); ++n) {
        Perlin3DTile::Octave& o = tile.octaves[n];
        o.size = octaves[n].size;
        o.inverseSize = 1.0f / static_cast<float>(o.size);
        o.seed = seed + octaves[n].seedStep;
        o.x = axisCells(grid.x, grid.step, o.size);
        const AxisCells y = axisCells(grid.y, grid.step, o.size);
        o.yCell = y.cell[0];
        o.layer.weight = octaves[n].weight;
        setRows(o.layer, y);
    }
}

void moveToCellsOf(Perlin3DTile& tile, std::int32_t z) {
    const bool first = tile.layer == kNoLayer;
    for (Perlin3DTile::Octave& o : tile.octaves) {
        // A division takes as long as blending a level.
        const bool isInCell = !first && z >= o.zStart && z - o.zStart < o.size;
        if (!isInCell) {
            const std::int32_t zCell = cellOfLayer(z, o.size);
            if (!first && z - o.zStart >= o.size && z - o.zStart < 2 * o.size) {
                o.low = 1 - o.low;
            } else {
                fillLevel(o, zCell, o.levels[o.low]);
            }
            fillLevel(o, zCell + 1, o.levels[1 - o.low]);
            o.zStart = zCell * o.size;
        }
        o.zOffset = static_cast<float>(z - o.zStart) * o.inverseSize;
        o.zFade = fade(o.zOffset);
    }
    tile.layer = z;
}

}  // namespace terrane::gen
