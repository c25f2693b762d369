#include "terrane/volume/read_surfaces.h"

#include <algorithm>
#include <vector>

#include "terrane/volume/read_chunks.h"

namespace terrane::volume {
namespace {

// Width and height of a piece, which one thread reads: 8×8 chunks of 16 columns.
constexpr int kPieceColumns = 128;

// Piece `number` of an area, by y, then x; those at its end may be smaller.
map::ColumnRect pieceOf(const ColumnArea& area, std::int64_t number) {
    const std::int64_t inRow = (area.x1 - area.x0 + kPieceColumns - 1) / kPieceColumns;
    const std::int64_t x = area.x0 + number % inRow * kPieceColumns,
                       y = area.y0 + number / inRow * kPieceColumns;
    return {area.level, x, y, static_cast<int>(std::min<std::int64_t>(kPieceColumns, area.x1 - x)),
            static_cast<int>(std::min<std::int64_t>(kPieceColumns, area.y1 - y))};
}

std::int64_t pieceCount(const ColumnArea& area) {
    const auto pieces = [](std::int64_t columns) { return (columns + kPieceColumns - 1) / kPieceColumns; };
    return pieces(area.x1 - area.x0) * pieces(area.y1 - area.y0);
}

void copyPiece(const map::SurfaceArea& piece, const ColumnArea& area, SurfaceLayer layer,
               world::Heights heights, const SurfaceArrays& arrays) {
    for (int y = 0; y < piece.rect.height; ++y)
        for (int x = 0; x < piece.rect.width; ++x) {
            const map::SurfaceColumn& column = piece.at(x, y);
            const bool isTop = layer == SurfaceLayer::Top;
            const world::BlockId id = isTop ? column.top : column.under;
            const int z = isTop ? column.topZ : column.underZ;
            const auto to = static_cast<std::size_t>((piece.rect.y0 + y - area.y0) * (area.x1 - area.x0) +
                                                     piece.rect.x0 + x - area.x0);
            if (!arrays.heights.empty())
                arrays.heights[to] = id == world::kAir ? noHeight(heights) : static_cast<std::int16_t>(z);
            if (!arrays.blocks.empty()) arrays.blocks[to] = id;
        }
}

}  // namespace

base::Result<ColumnArea> columnsOver(int level, std::int64_t x0, std::int64_t y0, std::int64_t x1,
                                     std::int64_t y1) {
    using base::ErrorCode;
    if (level < 0 || level > world::kMaxLevel)
        return base::fail(ErrorCode::BadInput, "level {}: expected 0 to {}", level, world::kMaxLevel);
    constexpr std::int64_t kEdge = std::int64_t{1} << 31;
    if (std::min(x0, y0) < -kEdge || std::max(x1, y1) > kEdge || x0 >= x1 || y0 >= y1)
        return base::fail(ErrorCode::BadInput,
                          "area: {}, {}, {}, {}: expected x0 < x1 and y0 < y1 from -2^31 to 2^31", x0, y0, x1,
                          y1);
    const auto above = [level](std::int64_t end) { return ((end - 1) >> level) + 1; };
    const ColumnArea area{level, x0 >> level, y0 >> level, above(x1), above(y1)};
    if (area.x1 - area.x0 > kMaxColumns / (area.y1 - area.y0))
        return base::fail(ErrorCode::BadInput,
                          "area: {} × {} columns are more than {}; a larger step has fewer",
                          area.x1 - area.x0, area.y1 - area.y0, kMaxColumns);
    return area;
}

base::Result<void> readSurfaces(OpenedWorld& world, const ColumnArea& area, SurfaceLayer layer,
                                const SurfaceArrays& arrays, const ShouldContinue& shouldContinue) {
    if (area.level > 0) TERRANE_TRY(world.waitForTiles());
    return forEachPart(world, pieceCount(area), shouldContinue,
                       [&](std::int64_t number) -> base::Result<void> {
                           const map::ColumnRect rect = pieceOf(area, number);
                           const auto edited = TERRANE_TRY(world.editedAmong(map::chunksTouching(rect)));
                           const auto piece = TERRANE_TRY(world.surfaces().area(rect, edited));
                           copyPiece(piece, area, layer, world.heights(), arrays);
                           return {};
                       });
}

namespace {

void copyBiomes(const gen::Biomes& biomes, const map::ColumnRect& rect, const ColumnArea& area,
                std::span<std::uint8_t> copied) {
    std::vector<std::uint8_t> piece(static_cast<std::size_t>(rect.width) *
                                    static_cast<std::size_t>(rect.height));
    for (const world::ChunkPos chunk : map::chunksTouching(rect))
        map::copyChunk(rect, chunk, biomes.of(chunk), piece);
    for (int y = 0; y < rect.height; ++y)
        std::copy_n(piece.begin() + std::ptrdiff_t{y} * rect.width, rect.width,
                    copied.begin() + (rect.y0 + y - area.y0) * (area.x1 - area.x0) + rect.x0 - area.x0);
}

}  // namespace

base::Result<void> readBiomes(OpenedWorld& world, const ColumnArea& area, std::span<std::uint8_t> biomes,
                              const ShouldContinue& shouldContinue) {
    const gen::Biomes* source = world.biomes();
    if (source == nullptr)
        return base::fail(base::ErrorCode::Unsupported, "the generator {} has no biomes",
                          world.store().identity().generator);
    return forEachPart(world, pieceCount(area), shouldContinue,
                       [&](std::int64_t number) -> base::Result<void> {
                           copyBiomes(*source, pieceOf(area, number), area, biomes);
                           return {};
                       });
}

}  // namespace terrane::volume
