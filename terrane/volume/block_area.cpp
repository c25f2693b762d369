#include "terrane/volume/block_area.h"

#include <algorithm>
#include <cassert>

namespace terrane::volume {
namespace {

constexpr std::int64_t kFirstBlock = std::int64_t{world::kMinChunk} * world::kChunkSize;
constexpr std::int64_t kEndBlock = (std::int64_t{world::kMaxChunk} + 1) * world::kChunkSize;

base::Result<void> checkAxis(char axis, std::int64_t first, std::int64_t end, std::int64_t low,
                             std::int64_t high) {
    if (first < low || end > high)
        return base::fail(base::ErrorCode::BadInput, "area: {0}0 = {1} and {0}1 = {2}: expected {3} to {4}",
                          axis, first, end, low, high);
    if (first >= end)
        return base::fail(base::ErrorCode::BadInput, "area: {0}0 = {1} is not less than {0}1 = {2}", axis,
                          first, end);
    return {};
}

}  // namespace

base::Result<void> checkArea(const BlockArea& area, world::Heights heights) {
    TERRANE_TRY(checkAxis('x', area.x0, area.x1, kFirstBlock, kEndBlock));
    TERRANE_TRY(checkAxis('y', area.y0, area.y1, kFirstBlock, kEndBlock));
    TERRANE_TRY(checkAxis('z', area.z0, area.z1, heights.bottom, heights.top));
    // Sides are at most 2^32: products are compared by division.
    if (area.width() > kMaxAreaBlocks / area.depth() / area.height())
        return base::fail(base::ErrorCode::BadInput, "area: {} × {} × {} blocks are more than {}",
                          area.width(), area.depth(), area.height(), kMaxAreaBlocks);
    return {};
}

world::ChunkArea chunksOver(const BlockArea& area) {
    const auto chunk = [](std::int64_t block) { return static_cast<std::int32_t>(block >> 4); };
    return {chunk(area.x0), chunk(area.y0), chunk(area.x1 - 1) + 1, chunk(area.y1 - 1) + 1};
}

world::ChunkPos chunkIn(const world::ChunkArea& area, std::int64_t number) {
    const std::int64_t width = std::int64_t{area.x1} - area.x0;
    return {static_cast<std::int32_t>(area.x0 + number % width),
            static_cast<std::int32_t>(area.y0 + number / width)};
}

ChunkPart partOf(const BlockArea& area, world::ChunkPos chunk) {
    const std::int64_t left = std::int64_t{chunk.x} * world::kChunkSize,
                       bottom = std::int64_t{chunk.y} * world::kChunkSize;
    const auto within = [](std::int64_t block) {
        return static_cast<int>(std::clamp<std::int64_t>(block, 0, world::kChunkSize));
    };
    ChunkPart part{within(area.x0 - left), within(area.y0 - bottom), static_cast<int>(area.z0),
                   within(area.x1 - left), within(area.y1 - bottom), static_cast<int>(area.z1)};
    assert(part.x0 < part.x1 && part.y0 < part.y1 && "the chunk touches the area");
    part.first = (bottom + part.y0 - area.y0) * area.width() + left + part.x0 - area.x0;
    return part;
}

}  // namespace terrane::volume
