#include "terrane/io/export_formats.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <filesystem>
#include <utility>

#include "terrane/base/files.h"
#include "terrane/base/image.h"
#include "terrane/base/npy.h"
#include "terrane/formats/glb_mesh.h"
#include "terrane/formats/gray_png.h"
#include "terrane/formats/schematic.h"
#include "terrane/formats/vox_file.h"
#include "terrane/io/loaded_square.h"
#include "terrane/mesh/chunk_mesher.h"

namespace terrane::io {

namespace {

namespace fs = std::filesystem;

base::Result<ExportedFile> writeResult(const fs::path& output, const base::Result<std::string>& bytes,
                                       std::string content) {
    if (!bytes) return base::fail(bytes.error().code, "{}: {}", output.string(), bytes.error().message);
    TERRANE_TRY(base::writeFile(output, *bytes));
    return ExportedFile{std::move(content), bytes->size()};
}

// The chunk with air outside the box, so that the mesh is closed on all sides.
world::Chunk clipped(const world::Chunk& chunk, world::ChunkPos pos, const world::BlockBox& box) {
    if (!world::isInWorld(pos)) return chunk;  // empty
    const world::BlockPos low = world::blockPos(pos, 0);
    world::Chunk result = chunk;
    const world::Heights heights = chunk.heights();
    for (world::BlockIndex index = world::blockIndex(0, 0, heights.bottom);
         index < world::blockIndex(0, 0, heights.top); ++index) {
        const std::int64_t x = std::int64_t{low.x} + (index & 15),
                           y = std::int64_t{low.y} + (index >> 4 & 15);
        const int z = index >> 8;
        const bool isInside = x >= box.low.x && x <= box.high.x && y >= box.low.y && y <= box.high.y &&
                              z >= box.low.z && z <= box.high.z;
        if (!isInside && result.block(index) != world::kAir) result.setBlock(index, world::kAir);
    }
    return result;
}

base::Result<void> addSquare(const LoadedSquare& square, const ExportSource& source, formats::GlbMesh& mesh) {
    const int width = square.chunksX() + 2;
    std::vector<world::Chunk> chunks;
    for (int y = -1; y <= square.chunksY(); ++y)
        for (int x = -1; x <= square.chunksX(); ++x)
            chunks.push_back(
                clipped(square.chunk(x, y), {square.area().x0 + x, square.area().y0 + y}, source.box));
    const auto chunk = [&](int x, int y) {
        return &chunks[static_cast<std::size_t>(x + 1 + (y + 1) * width)];
    };
    mesh::MeshScratch scratch;
    for (int y = 0; y < square.chunksY(); ++y) {
        for (int x = 0; x < square.chunksX(); ++x) {
            const mesh::MeshInput input{chunk(x, y),
                                        {chunk(x - 1, y), chunk(x + 1, y), chunk(x, y - 1), chunk(x, y + 1)},
                                        source.blocks.get(),
                                        {}};
            const world::BlockPos at = world::blockPos({square.area().x0 + x, square.area().y0 + y}, 0);
            // Relative to the box's lowest corner, to keep precision far from the origin.
            const glm::ivec3 corner(std::int64_t{at.x} - source.box.low.x,
                                    std::int64_t{at.y} - source.box.low.y, -source.box.low.z);
            TERRANE_TRY(mesh.add(mesh::meshChunk(input, scratch), corner));
        }
    }
    return {};
}

}  // namespace

base::Result<ExportedFile> exportGlb(const ExportSource& source, const fs::path& output,
                                     const Progress& progress) {
    const world::ChunkArea area = chunksOf(source.box);
    formats::GlbMesh mesh(*source.blocks, source.textures);
    base::JobSystem jobs(source.threads);
    const auto shouldContinue = [&](std::int64_t done) {
        return !progress ||
               progress(static_cast<std::size_t>(done), static_cast<std::size_t>(squareCount(area)));
    };
    for (std::int64_t k = 0; k < squareCount(area); ++k) {
        if (!shouldContinue(k)) return base::fail("stopped after {} of {} squares", k, squareCount(area));
        LoadedSquare square(squareOf(area, k));
        TERRANE_TRY(square.load(source.save.get(), source.generator, jobs));
        TERRANE_TRY(addSquare(square, source, mesh));
    }
    (void)shouldContinue(squareCount(area));
    const world::BlockPos low = source.box.low;
    const auto model = mesh.finish(fmt::format("terrane {},{},{}", low.x, low.y, low.z));
    if (!model) return base::fail(model.error().code, "{}: {}", output.string(), model.error().message);
    return writeResult(output, formats::encodeGlb(*model),
                       fmt::format("{} faces, {} materials", mesh.quadCount(), model->parts.size()));
}

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

std::string describe(glm::ivec3 size) {
    return fmt::format("{}×{}×{} blocks", size.x, size.y, size.z);
}

template <class Value>
std::string bytesOf(const std::vector<Value>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

// Row by row, y ascending.
struct SurfaceHeights {
    int width = 0, height = 0;  // columns
    std::vector<std::int16_t> values;
};

std::int16_t heightOf(const world::Chunk& chunk, const world::BlockRegistry& blocks, int column,
                      const world::BlockBox& box) {
    for (int z = box.high.z; z >= box.low.z; --z) {
        const world::BlockType& type = blocks.type(chunk.block(column + world::kBlocksPerLayer * z));
        if (!type.collision.empty() || type.shape == world::Shape::Liquid)
            return static_cast<std::int16_t>(z);
    }
    return static_cast<std::int16_t>(chunk.heights().bottom);
}

base::Result<SurfaceHeights> readHeights(const ExportSource& source, const Progress& progress) {
    const world::BlockBox& box = source.box;
    const std::int64_t width = std::int64_t{box.high.x} - box.low.x + 1;
    const std::int64_t height = std::int64_t{box.high.y} - box.low.y + 1;
    if (width > base::kMaxImagePixels / height)  // the product may overflow
        return base::fail(base::ErrorCode::OutOfResources, "{}×{} columns are more than {}", width, height,
                          base::kMaxImagePixels);
    SurfaceHeights heights{static_cast<int>(width), static_cast<int>(height), {}};
    heights.values.resize(static_cast<std::size_t>(width * height));
    TERRANE_TRY(forEachChunk(source, progress, [&](world::ChunkPos pos, const world::Chunk& chunk) {
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

std::string namesOf(const world::BlockRegistry& blocks) {
    nlohmann::json names = nlohmann::json::array();
    for (const world::BlockType& type : blocks.types()) names.push_back(type.name);
    return names.dump(1) + "\n";
}

}  // namespace

base::Result<ExportedFile> exportSchematic(const ExportSource& source, const fs::path& output,
                                           const std::string& mappingFile, const Progress& progress) {
    const auto mapping = TERRANE_TRY(formats::loadMapping(*source.blocks, mappingFile));
    const auto volume = TERRANE_TRY(readVolume(source, progress));
    return writeResult(output, formats::encodeSchematic(formats::toNames(volume, mapping)),
                       describe(volume.size));
}

base::Result<ExportedFile> exportVox(const ExportSource& source, const fs::path& output,
                                     const Progress& progress) {
    const auto tops = TERRANE_TRY(world::topColors(*source.blocks, source.textures));
    const auto volume = TERRANE_TRY(readVolume(source, progress));
    const auto image = TERRANE_TRY(formats::toVox(volume, tops));
    return writeResult(output, formats::encodeVox(image), describe(volume.size));
}

base::Result<ExportedFile> exportNpy(const ExportSource& source, const fs::path& output,
                                     const Progress& progress) {
    auto volume = TERRANE_TRY(readVolume(source, progress));
    for (std::uint16_t& cell : volume.cells) cell = volume.palette[cell].id;
    const auto side = [&](int axis) { return static_cast<std::size_t>(volume.size[axis]); };
    const std::string bytes = base::encodeNpy({"<u2", {side(2), side(1), side(0)}, bytesOf(volume.cells)});
    const std::string names = namesOf(*source.blocks);
    TERRANE_TRY(base::writeFiles(
        std::vector<base::FileToWrite>{{output.string(), bytes}, {output.string() + ".names.json", names}}));
    return ExportedFile{describe(volume.size), bytes.size()};
}

base::Result<ExportedFile> exportNpyHeights(const ExportSource& source, const fs::path& output,
                                            const Progress& progress) {
    const auto heights = TERRANE_TRY(readHeights(source, progress));
    const std::vector<std::size_t> shape{static_cast<std::size_t>(heights.height),
                                         static_cast<std::size_t>(heights.width)};
    const char* type = source.generator.heights().bottom < 0 ? "<i2" : "<u2";
    return writeResult(output, base::encodeNpy({type, shape, bytesOf(heights.values)}),
                       fmt::format("{}×{} columns", heights.width, heights.height));
}

base::Result<ExportedFile> exportPngHeights(const ExportSource& source, const fs::path& output, int bits,
                                            const Progress& progress) {
    const auto heights = TERRANE_TRY(readHeights(source, progress));
    formats::GrayImage image{heights.width, heights.height, bits, {}};
    const auto width = static_cast<std::size_t>(heights.width);
    // The world's lowest layer is black, its highest one white.
    const world::Heights world = source.generator.heights();
    const int white = bits == 16 ? 65535 : 255, range = world.layers() - 1;
    for (std::size_t row = 0; row < static_cast<std::size_t>(heights.height); ++row) {
        for (std::size_t x = width; x-- > 0;) {
            const int above = heights.values[row * width + x] - world.bottom;
            image.values.push_back(static_cast<std::uint16_t>(above * white / range));
        }
    }
    return writeResult(output, formats::encodeGrayPng(image),
                       fmt::format("{}×{} columns", heights.width, heights.height));
}

}  // namespace terrane::io
