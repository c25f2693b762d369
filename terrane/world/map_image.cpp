#include "terrane/world/map_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "terrane/world/coords.h"
#include "terrane/world/top_colors.h"

namespace terrane::world {
namespace {

constexpr float kReliefPerBlock = 0.07f;  // brightness a block of difference to the column in the north-west
constexpr float kWaterFade = 14.0f;       // blocks of water after which the ground is hardly seen

// Of a row, about 10 KB each in memory.
constexpr std::size_t kChunksAtOnce = 512;

// What a map shows of a column.
struct Column {
    BlockId ground = kAir;
    std::uint8_t height = 0;      // of the ground
    std::uint8_t waterDepth = 0;  // blocks of liquid above it
    BlockId liquid = kAir;
    PackedColor tint = kNeutralTint;
};

// Plants are too small for a map: the ground under them is shown.
Column lookDown(const Chunk& chunk, const BlockRegistry& blocks, int x, int y) {
    Column column;
    for (int z = kChunkHeight; z-- > 0;) {
        const BlockId id = chunk.block(blockIndex(x, y, z));
        const Shape shape = blocks.type(id).shape;
        if (shape == Shape::None || shape == Shape::Cross || shape == Shape::Hash) continue;
        if (shape == Shape::Liquid) {
            column.liquid = id;
            ++column.waterDepth;
            continue;
        }
        column.ground = id;
        column.height = static_cast<std::uint8_t>(z);
        break;
    }
    return column;
}

// `width`: of a column, blocks.
glm::vec3 shade(const Column& column, const Column& northWest, float width, const TopColors& palette) {
    const float rise = (static_cast<float>(column.height) - static_cast<float>(northWest.height)) / width;
    const float light = std::clamp(0.95f - std::clamp(-rise, -3.0f, 3.0f) * kReliefPerBlock, 0.6f, 1.25f);
    const TopColor& top = palette[column.ground];
    const glm::vec3 color = top.tinted ? 255.0f * tinted(top.mean / 255.0f, column.tint) : top.mean;
    const glm::vec3 ground = color * light;
    if (column.waterDepth == 0) return ground;
    const float depth = static_cast<float>(column.waterDepth);
    const glm::vec3 water = palette[column.liquid].mean * (0.6f + 0.4f * std::exp(-depth / kWaterFade));
    return glm::mix(water, ground, 0.5f * std::exp(-depth / (0.4f * kWaterFade)));
}

}  // namespace

base::Result<base::Image> drawMap(const MapSource& source, const BlockRegistry& blocks,
                                  const TextureSource& textures, base::JobSystem& jobs,
                                  const std::function<void(std::size_t)>& onRow) {
    const ChunkArea& area = source.area;
    auto palette = topColors(blocks, textures);
    if (!palette) return tl::unexpected(palette.error());
    const auto chunksX = static_cast<std::size_t>(area.x1 - area.x0);
    const auto chunksY = static_cast<std::size_t>(area.y1 - area.y0);
    const std::size_t width = chunksX * kChunkSize, height = chunksY * kChunkSize;
    std::vector<Column> columns(width * height);
    for (std::size_t cy = 0; cy < chunksY; ++cy) {
        for (std::size_t first = 0; first < chunksX; first += kChunksAtOnce) {
            std::vector<ChunkPos> positions;
            for (std::size_t cx = first; cx < std::min(first + kChunksAtOnce, chunksX); ++cx)
                positions.push_back({area.x0 + static_cast<std::int32_t>(cx),
                                     area.y0 + static_cast<std::int32_t>(cy), source.level});
            const auto chunks = source.chunks(positions);
            if (!chunks) return tl::unexpected(chunks.error());
            auto done = base::parallelFor(jobs, chunks->size(), [&](std::size_t n) {
                const auto tints = source.tint ? std::optional(source.tint(positions[n])) : std::nullopt;
                for (int k = 0; k < kChunkSize * kChunkSize; ++k) {
                    const std::size_t x = (first + n) * kChunkSize + static_cast<std::size_t>(k & 15);
                    const std::size_t y = cy * kChunkSize + static_cast<std::size_t>(k >> 4);
                    Column& column = columns[y * width + x];
                    column = lookDown((*chunks)[n], blocks, k & 15, k >> 4);
                    if (tints) column.tint = (*tints)[static_cast<std::size_t>(k)];
                }
            });
            if (!done) return tl::unexpected(done.error());
        }
        onRow(cy + 1);
    }
    const auto blocksWide = static_cast<float>(1 << source.level);
    base::Image image{static_cast<int>(width), static_cast<int>(height), {}};
    image.rgba.reserve(columns.size() * 4);
    for (std::size_t row = 0; row < height; ++row) {
        const std::size_t y = height - 1 - row;
        for (std::size_t x = 0; x < width; ++x) {
            const Column& northWest = columns[std::min(y + 1, height - 1) * width + (x > 0 ? x - 1 : 0)];
            const glm::vec3 color = shade(columns[y * width + x], northWest, blocksWide, *palette);
            for (int c = 0; c < 3; ++c) {
                image.rgba.push_back(static_cast<std::uint8_t>(std::clamp(color[c], 0.0f, 255.0f)));
            }
            image.rgba.push_back(255);
        }
    }
    return image;
}

}  // namespace terrane::world
