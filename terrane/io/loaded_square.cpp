#include "terrane/io/loaded_square.h"

#include <algorithm>

namespace terrane::io {

namespace {

std::int64_t squaresOver(std::int32_t first, std::int32_t end) {
    return (std::int64_t{end} - first + kSquareChunks - 1) / kSquareChunks;
}

}  // namespace

std::int64_t squareCount(const world::ChunkArea& area) {
    return squaresOver(area.x0, area.x1) * squaresOver(area.y0, area.y1);
}

world::ChunkArea squareOf(const world::ChunkArea& area, std::int64_t number) {
    const std::int64_t inRow = squaresOver(area.x0, area.x1);
    const auto x0 = static_cast<std::int32_t>(area.x0 + number % inRow * kSquareChunks);
    const auto y0 = static_cast<std::int32_t>(area.y0 + number / inRow * kSquareChunks);
    return {x0, y0, std::min(x0 + kSquareChunks, area.x1), std::min(y0 + kSquareChunks, area.y1)};
}

base::Result<void> LoadedSquare::load(store::ChunkStore* save, const gen::Generator& generator,
                                      base::JobSystem& jobs) {
    std::vector<world::ChunkPos> positions;
    for (int k = 0; k < width_ * height_; ++k)
        positions.push_back({area_.x0 - 1 + k % width_, area_.y0 - 1 + k / width_});
    auto chunks = TERRANE_TRY(stream::chunksAt(positions, save, generator, jobs));
    chunks_ = std::move(chunks);
    return {};
}

}  // namespace terrane::io
