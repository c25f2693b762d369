#include "apps/terrane/formats/volume_export.h"

#include <bit>
#include <nlohmann/json.hpp>

#include "apps/terrane/formats/export_source.h"
#include "terrane/base/files.h"
#include "terrane/base/image.h"
#include "terrane/base/log.h"
#include "terrane/base/npy.h"
#include "terrane/formats/gray_png.h"
#include "terrane/formats/schematic.h"
#include "terrane/formats/vox_blocks.h"

namespace terrane::app {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

base::Result<void> writeResult(const ExportOptions& options, const base::Result<std::string>& bytes,
                               const std::string& what) {
    if (!bytes) return base::fail(bytes.error().code, "{}: {}", options.output, bytes.error().message);
    TERRANE_TRY(base::writeFile(options.output, *bytes));
    base::logInfo("{}: {}, {} bytes", options.output, what, bytes->size());
    return {};
}

std::string describe(glm::ivec3 size) {
    return fmt::format("{}×{}×{} blocks", size.x, size.y, size.z);
}

std::string bytesOf(const std::vector<std::uint16_t>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(std::uint16_t)};
}

// Row by row, y ascending.
struct SurfaceHeights {
    int width = 0, height = 0;  // columns
    std::vector<std::uint16_t> values;
};

std::uint16_t heightOf(const world::Chunk& chunk, const world::BlockRegistry& blocks, int column,
                       const world::BlockBox& box) {
    for (int z = box.high.z; z >= box.low.z; --z) {
        const world::BlockType& type =
            blocks.type(chunk.block(static_cast<world::BlockIndex>(column + 256 * z)));
        if (!type.collision.empty() || type.shape == world::Shape::Liquid)
            return static_cast<std::uint16_t>(z);
    }
    return 0;
}

base::Result<SurfaceHeights> readHeights(ExportOptions& options) {
    const auto source = TERRANE_TRY(openExport(options));
    const world::BlockBox& box = source.box;
    const std::int64_t width = std::int64_t{box.high.x} - box.low.x + 1;
    const std::int64_t height = std::int64_t{box.high.y} - box.low.y + 1;
    if (width * height > base::kMaxImagePixels)
        return base::fail(base::ErrorCode::OutOfResources, "{}×{} columns are more than {}", width, height,
                          base::kMaxImagePixels);
    SurfaceHeights heights{static_cast<int>(width), static_cast<int>(height), {}};
    heights.values.resize(static_cast<std::size_t>(width * height));
    TERRANE_TRY(forEachChunk(options, source, [&](world::ChunkPos pos, const world::Chunk& chunk) {
        const world::BlockPos low = world::blockPos(pos, 0);
        for (int k = 0; k < world::kChunkSize * world::kChunkSize; ++k) {
            const std::int64_t x = std::int64_t{low.x} + k % world::kChunkSize - box.low.x;
            const std::int64_t y = std::int64_t{low.y} + k / world::kChunkSize - box.low.y;
            if (x < 0 || x >= width || y < 0 || y >= height) continue;
            heights.values[static_cast<std::size_t>(x + width * y)] = heightOf(chunk, *source.blocks, k, box);
        }
        return base::Result<void>();
    }));
    return heights;
}

base::Result<void> writeNames(const ExportOptions& options, const world::BlockRegistry& blocks) {
    nlohmann::json names = nlohmann::json::array();
    for (const world::BlockType& type : blocks.types()) names.push_back(type.name);
    return base::writeFile(options.output + ".names.json", names.dump(1) + "\n");
}

}  // namespace

base::Result<void> exportSchematic(ExportOptions& options) {
    const auto source = TERRANE_TRY(openExport(options));
    const auto mapping = TERRANE_TRY(formats::loadMapping(*source.blocks, options.mapping));
    const auto volume = TERRANE_TRY(readVolume(options, source));
    return writeResult(options, formats::encodeSchematic(formats::toNames(volume, mapping)),
                       describe(volume.size));
}

base::Result<void> exportVox(ExportOptions& options) {
    const auto source = TERRANE_TRY(openExport(options));
    const auto tops = TERRANE_TRY(world::topColors(*source.blocks, source.textures));
    const auto volume = TERRANE_TRY(readVolume(options, source));
    const auto image = TERRANE_TRY(formats::toVox(volume, tops));
    return writeResult(options, formats::encodeVox(image), describe(volume.size));
}

base::Result<void> exportNpy(ExportOptions& options) {
    const auto source = TERRANE_TRY(openExport(options));
    auto volume = TERRANE_TRY(readVolume(options, source));
    for (std::uint16_t& cell : volume.cells) cell = volume.palette[cell].id;
    const auto side = [&](int axis) { return static_cast<std::size_t>(volume.size[axis]); };
    TERRANE_TRY(writeNames(options, *source.blocks));
    return writeResult(options, base::encodeNpy({"<u2", {side(2), side(1), side(0)}, bytesOf(volume.cells)}),
                       describe(volume.size));
}

base::Result<void> exportNpyHeights(ExportOptions& options) {
    const auto heights = TERRANE_TRY(readHeights(options));
    const std::vector<std::size_t> shape{static_cast<std::size_t>(heights.height),
                                         static_cast<std::size_t>(heights.width)};
    return writeResult(options, base::encodeNpy({"<u2", shape, bytesOf(heights.values)}),
                       fmt::format("{}×{} columns", heights.width, heights.height));
}

base::Result<void> exportPngHeights(ExportOptions& options) {
    const auto heights = TERRANE_TRY(readHeights(options));
    formats::GrayImage image{heights.width, heights.height, options.bits, {}};
    const auto width = static_cast<std::size_t>(heights.width);
    for (std::size_t row = 0; row < static_cast<std::size_t>(heights.height); ++row) {
        for (std::size_t x = width; x-- > 0;) {
            // Maps 255 to 65,535.
            const std::uint16_t height = heights.values[row * width + x];
            image.values.push_back(options.bits == 16 ? static_cast<std::uint16_t>(height * 257) : height);
        }
    }
    return writeResult(options, formats::encodeGrayPng(image),
                       fmt::format("{}×{} columns", heights.width, heights.height));
}

}  // namespace terrane::app
