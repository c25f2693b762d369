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

bool reaches(const StampFoot& foot) {
    const auto& [low, high] = std::pair(foot.shape->low, foot.shape->high);
    return foot.x + high[0] >= 0 && foot.x + low[0] < kTileSize && foot.y + high[1] >= 0 &&
           foot.y + low[1] < kTileSize && foot.z + high[2] >= 0 && foot.z + low[2] < world::kChunkHeight;
}

}  // namespace

void StampTile::paint(const ShapeTable& shapes, std::span<const Bits> numbers, std::span<const Bits> bases) {
    assert(numbers.size() == std::size_t{kWindowSize} * kWindowSize && bases.size() == numbers.size() &&
           "each column of the window has both fields");
    clear();
    findFeet(shapes, numbers, bases);
    // The block painted first stays: feet are in the order of precedence.
    for (std::size_t rank = kMaxShapeRank + 1; rank-- > 0;) {
        for (const StampFoot& foot : feet_) {
            const auto& first = foot.shape->firstRun;
            for (std::uint32_t k = first[rank]; k < first[rank + 1]; ++k) paintRun(foot, shapes.runs[k]);
        }
    }
}

bool StampTile::isPainted(int low, int high) const {
    return std::find(painted_.begin() + low, painted_.begin() + high + 1, true) !=
           painted_.begin() + high + 1;
}

const std::uint16_t* StampTile::layer(int z) const {
    assert(isPainted(z) && "paint() comes first");
    return blocks_.data() + static_cast<std::size_t>(z) * kTileLanes;
}

void StampTile::clear() {
    blocks_.resize(world::kBlocksPerChunk);
    for (std::size_t z = 0; z < painted_.size(); ++z) {
        if (painted_[z]) std::fill_n(blocks_.begin() + static_cast<long>(z) * kTileLanes, kTileLanes, 0);
    }
    painted_.fill(false);
}

void StampTile::findFeet(const ShapeTable& shapes, std::span<const Bits> numbers,
                         std::span<const Bits> bases) {
    // Shapes whose feet are beyond these heights do not reach the world; sums of other heights do not
    // overflow.
    constexpr int kLowest = -kMaxShapeZ, kHighest = world::kChunkHeight - kMinShapeZ;
    feet_.clear();
    for (int y = 0; y < kWindowSize; ++y) {
        const std::size_t row = static_cast<std::size_t>(y) * kWindowSize;
        if (isEmptyRow(numbers.data() + row)) continue;
        for (int x = 0; x < kWindowSize; ++x) {
            const std::size_t at = row + static_cast<std::size_t>(x);
            const std::int32_t base = asInt(bases[at]);
            if (numbers[at] >= shapes.shapes.size() || base < kLowest || base > kHighest) continue;
            const StampFoot foot = {&shapes.shapes[numbers[at]], x - kMaxReadOffset, y - kMaxReadOffset,
                                    base};
            if (reaches(foot)) feet_.push_back(foot);
        }
    }
}

void StampTile::paintRun(const StampFoot& foot, const ShapeRun& run) {
    const int y = foot.y + run.y, z = foot.z + run.z;
    if (y < 0 || y >= kTileSize || z < 0 || z >= world::kChunkHeight) return;
    const int low = std::max(0, foot.x + run.x), high = std::min(kTileSize, foot.x + run.x + run.length);
    if (low >= high) return;
    std::uint16_t* row = blocks_.data() + z * kTileLanes + y * kTileSize;
    for (int x = low; x < high; ++x) row[x] = row[x] == 0 ? run.block : row[x];
    painted_[static_cast<std::size_t>(z)] = true;
}

}  // namespace terrane::gen
