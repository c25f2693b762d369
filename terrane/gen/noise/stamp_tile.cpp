#include "terrane/gen/noise/stamp_tile.h"

#include <algorithm>
#include <cassert>

#include "terrane/gen/cpu/kernels.h"

namespace terrane::gen {
namespace {

// Whether no shape stands in a row of columns: all numbers are negative, as they are mostly.
bool isEmptyRow(const Bits* numbers) {
    Bits all = ~Bits{0};
    for (int x = 0; x < kWindowSize; ++x) all &= numbers[x];
    return asInt(all) < 0;
}

bool reaches(const StampFoot& foot, world::Heights heights) {
    const auto& [low, high] = std::pair(foot.shape->low, foot.shape->high);
    return foot.x + high[0] >= 0 && foot.x + low[0] < kTileSize && foot.y + high[1] >= 0 &&
           foot.y + low[1] < kTileSize && foot.z + high[2] >= heights.bottom && foot.z + low[2] < heights.top;
}

}  // namespace

void StampTile::paint(const ShapeTable& shapes, world::Heights heights, std::span<const Bits> numbers,
                      std::span<const Bits> bases) {
    assert(numbers.size() == std::size_t{kWindowSize} * kWindowSize && bases.size() == numbers.size() &&
           "each column of the window has both fields");
    if (blocks_.heights() != heights) blocks_ = BlockLayers(heights);
    blocks_.clear();
    blocks_.fill(heights.bottom, heights.layers(), world::kAir);
    findFeet(shapes, numbers, bases);
    // The block painted first stays: feet are in the order of precedence.
    for (std::size_t rank = kMaxShapeRank + 1; rank-- > 0;) {
        for (const StampFoot& foot : feet_) {
            const auto& first = foot.shape->firstRun;
            paintRuns(foot, std::span(shapes.runs).subspan(first[rank], first[rank + 1] - first[rank]));
        }
    }
}

void StampTile::findFeet(const ShapeTable& shapes, std::span<const Bits> numbers,
                         std::span<const Bits> bases) {
    // Shapes whose feet are beyond these heights do not reach the world; sums of other heights do not
    // overflow.
    const world::Heights heights = blocks_.heights();
    const int lowest = heights.bottom - kMaxShapeZ, highest = heights.top - kMinShapeZ;
    feet_.clear();
    for (int y = 0; y < kWindowSize; ++y) {
        const std::size_t row = static_cast<std::size_t>(y) * kWindowSize;
        if (isEmptyRow(numbers.data() + row)) continue;
        for (int x = 0; x < kWindowSize; ++x) {
            const std::size_t at = row + static_cast<std::size_t>(x);
            const std::int32_t base = asInt(bases[at]);
            if (numbers[at] >= shapes.shapes.size() || base < lowest || base > highest) continue;
            const StampFoot foot = {&shapes.shapes[numbers[at]], x - kMaxReadOffset, y - kMaxReadOffset,
                                    base};
            if (reaches(foot, heights)) feet_.push_back(foot);
        }
    }
}

// The runs of a layer come one after the other.
void StampTile::paintRuns(const StampFoot& foot, std::span<const ShapeRun> runs) {
    std::uint16_t* layer = nullptr;
    int layerZ = 0;
    for (const ShapeRun& run : runs) {
        const int y = foot.y + run.y, z = foot.z + run.z;
        const int low = std::max(0, foot.x + run.x), high = std::min(kTileSize, foot.x + run.x + run.length);
        if (y < 0 || y >= kTileSize || low >= high || !blocks_.heights().contains(z)) continue;
        if (!layer || z != layerZ) layer = blocks_.edit(z);
        layerZ = z;
        std::uint16_t* row = layer + y * kTileSize;
        for (int x = low; x < high; ++x) row[x] = row[x] == 0 ? run.block : row[x];
    }
}

}  // namespace terrane::gen
