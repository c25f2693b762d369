// Heights of the land, the blocks on top, and biomes, by columns of any level of detail. Any thread; all of
// the world's threads work on a call.
#pragma once

#include <cstdint>
#include <span>

#include "terrane/volume/opened_world.h"

namespace terrane::volume {

// The height of a column without such a block: below the world.
constexpr std::int16_t noHeight(world::Heights heights) {
    return static_cast<std::int16_t>(heights.bottom - 1);
}
constexpr std::int64_t kMaxColumns = std::int64_t{1} << 28;  // 512 MiB of heights

// Columns of a level, x0 … x1 − 1 and y0 … y1 − 1, each 2^level blocks wide.
struct ColumnArea {
    int level = 0;
    std::int64_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

// Returns the columns of a level that cover blocks x0 … x1 − 1, y0 … y1 − 1. Returns BadInput if the level is
// not 0…15, the area is outside the world, is empty, or has more than kMaxColumns.
[[nodiscard]] base::Result<ColumnArea> columnsOver(int level, std::int64_t x0, std::int64_t y0,
                                                   std::int64_t x1, std::int64_t y1);

enum class SurfaceLayer : std::uint8_t {
    Top,     // the topmost block, trees and water too; no plants that one walks through
    Ground,  // the topmost block under trees and water; under trees that stand in water the water
};

// Arrays by y, then x. Either may be empty.
struct SurfaceArrays {
    std::span<std::int16_t> heights;   // z of the block, or noHeight()
    std::span<world::BlockId> blocks;  // its id, or air
};
[[nodiscard]] base::Result<void> readSurfaces(OpenedWorld& world, const ColumnArea& area, SurfaceLayer layer,
                                              const SurfaceArrays& arrays,
                                              const ShouldContinue& shouldContinue);

// Numbers of biomes (gen/generators/biomes.h) by y, then x. Unsupported if the generator has none.
[[nodiscard]] base::Result<void> readBiomes(OpenedWorld& world, const ColumnArea& area,
                                            std::span<std::uint8_t> biomes,
                                            const ShouldContinue& shouldContinue);

}  // namespace terrane::volume
