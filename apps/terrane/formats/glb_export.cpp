#include "apps/terrane/formats/glb_export.h"

#include <algorithm>

#include "apps/terrane/dump/loaded_square.h"
#include "apps/terrane/formats/export_source.h"
#include "apps/terrane/options.h"
#include "terrane/base/files.h"
#include "terrane/base/log.h"
#include "terrane/base/progress_bar.h"
#include "terrane/base/stop_signals.h"
#include "terrane/formats/glb_mesh.h"
#include "terrane/mesh/chunk_mesher.h"

namespace terrane::app {
namespace {

// The chunk with air outside the box, so that the mesh is closed on all sides.
world::Chunk clipped(const world::Chunk& chunk, world::ChunkPos pos, const world::BlockBox& box) {
    if (!world::isInWorld(pos)) return chunk;  // empty
    const world::BlockPos low = world::blockPos(pos, 0);
    world::Chunk result = chunk;
    for (int k = 0; k < world::kBlocksPerChunk; ++k) {
        const auto index = static_cast<world::BlockIndex>(k);
        const std::int64_t x = std::int64_t{low.x} + (k & 15), y = std::int64_t{low.y} + (k >> 4 & 15);
        const int z = k >> 8;
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

base::Result<void> exportGlb(ExportOptions& options) {
    const auto source = TERRANE_TRY(openExport(options));
    const world::ChunkArea area = chunksOf(source.box);
    formats::GlbMesh mesh(*source.blocks, source.textures);
    base::JobSystem jobs(threadCount(options.world));
    const base::StopSignals signals;
    {
        base::ProgressBar bar("exporting", static_cast<std::size_t>(squareCount(area)));
        for (std::int64_t k = 0; k < squareCount(area); ++k) {
            if (signals.stopAsked())
                return base::fail("stopped after {} of {} squares", k, squareCount(area));
            LoadedSquare square(squareOf(area, k));
            TERRANE_TRY(square.load(source.save.get(), source.generator, jobs));
            TERRANE_TRY(addSquare(square, source, mesh));
            bar.set(static_cast<std::size_t>(k) + 1);
        }
    }
    const world::BlockPos low = source.box.low;
    const auto model = mesh.finish(fmt::format("terrane {},{},{}", low.x, low.y, low.z));
    if (!model) return base::fail(model.error().code, "{}: {}", options.output, model.error().message);
    const auto bytes = formats::encodeGlb(*model);
    if (!bytes) return base::fail(bytes.error().code, "{}: {}", options.output, bytes.error().message);
    TERRANE_TRY(base::writeFile(options.output, *bytes));
    base::logInfo("{}: {} faces, {} materials, {} bytes", options.output, mesh.quadCount(),
                  model->parts.size(), bytes->size());
    return {};
}

}  // namespace terrane::app
