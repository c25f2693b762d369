#include "terrane/map/tint_field.h"

namespace terrane::map {
namespace {

// A column of a chunk this many levels up is 16 columns wide.
constexpr int kLevelsUp = 4;
static_assert(TintField::kStep == 1 << kLevelsUp);

}  // namespace

world::PackedColor TintSource::sample(int level, std::int64_t x, std::int64_t y) {
    const world::ChunkPos chunk = chunkAt(x >> 4, y >> 4, level);
    if (level > world::kMaxLevel || !generators_.hasTint() || !world::isInWorld(chunk))
        return world::kNeutralTint;
    std::shared_ptr<const world::TintTile> tile;
    {
        const std::lock_guard lock(mutex_);
        if (const auto* found = tiles_.find(chunk)) tile = *found;
    }
    if (!tile) {
        const auto made = generators_.tint(chunk);
        if (!made) return world::kNeutralTint;
        tile = std::make_shared<const world::TintTile>(*made);
        const std::lock_guard lock(mutex_);
        tiles_.put(chunk, tile, sizeof(world::TintTile) + 128);
    }
    return (*tile)[static_cast<std::size_t>((x & 15) + 16 * (y & 15))];
}

world::PackedColor TintSource::of(world::ChunkPos chunk) {
    return sample(chunk.level + kLevelsUp, chunk.x, chunk.y);
}

TintField TintSource::field(const ColumnRect& rect) {
    constexpr int kHalf = TintField::kStep / 2;
    // Sample n covers the columns from 16 n on and lies in their middle.
    const auto firstSample = [](std::int64_t column) { return (column - kHalf) >> kLevelsUp; };
    const std::int64_t left = firstSample(rect.x0), bottom = firstSample(rect.y0);
    TintField field{left * TintField::kStep + kHalf,
                    bottom * TintField::kStep + kHalf,
                    static_cast<int>(firstSample(rect.x0 + rect.width - 1) - left) + 2,
                    static_cast<int>(firstSample(rect.y0 + rect.height - 1) - bottom) + 2,
                    {}};
    const int level = rect.level + kLevelsUp;
    for (int j = 0; j < field.height; ++j)
        for (int i = 0; i < field.width; ++i) field.samples.push_back(sample(level, left + i, bottom + j));
    return field;
}

}  // namespace terrane::map
