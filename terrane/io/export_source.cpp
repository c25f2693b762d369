#include "terrane/io/export_source.h"

#include <algorithm>
#include <functional>
#include <unordered_map>
#include <utility>

#include "terrane/base/job_system.h"
#include "terrane/content/resource_pack.h"
#include "terrane/io/open_session.h"
#include "terrane/stream/area_chunks.h"

namespace terrane::io {
namespace {

// Chunks loaded at a time.
constexpr std::size_t kExportBatch = 64;

// Assigns palette entries to blocks and states in order of first use.
class VolumePalette {
  public:
    base::Result<std::uint16_t> entryOf(formats::BlockAndState block) {
        const std::uint32_t key = std::uint32_t{block.id} << 16 | block.state;
        const auto found = entries_.find(key);
        if (found != entries_.end()) return found->second;
        if (blocks.size() > UINT16_MAX)
            return base::fail("the box has more than 65,536 different blocks and states");
        blocks.push_back(block);
        return entries_.emplace(key, static_cast<std::uint16_t>(blocks.size() - 1)).first->second;
    }

    std::vector<formats::BlockAndState> blocks;

  private:
    std::unordered_map<std::uint32_t, std::uint16_t> entries_;
};

// Copies the part of the box in one chunk to the volume.
base::Result<void> copyChunk(const world::BlockBox& box, world::ChunkPos pos, const world::Chunk& chunk,
                             VolumePalette& palette, formats::BlockVolume& volume) {
    const world::BlockPos low = world::blockPos(pos, 0);
    for (int k = 0; k < world::kChunkSize * world::kChunkSize; ++k) {
        const std::int64_t x = std::int64_t{low.x} + k % world::kChunkSize - box.low.x;
        const std::int64_t y = std::int64_t{low.y} + k / world::kChunkSize - box.low.y;
        if (x < 0 || x >= volume.size.x || y < 0 || y >= volume.size.y) continue;
        for (int z = 0; z < volume.size.z; ++z) {
            const world::BlockIndex index = k + world::kBlocksPerLayer * (box.low.z + z);
            const auto entry = TERRANE_TRY(palette.entryOf({chunk.block(index), chunk.blockState(index)}));
            volume
                .cells[static_cast<std::size_t>(x + volume.size.x * (y + std::int64_t{volume.size.y} * z))] =
                entry;
        }
    }
    return {};
}

base::Result<world::BlockBox> boxOf(const std::variant<world::ChunkArea, world::BlockBox>& blocks,
                                    world::Heights heights) {
    if (const auto* box = std::get_if<world::BlockBox>(&blocks)) {
        if (heights.contains(box->low.z) && heights.contains(box->high.z)) return *box;
        return base::fail(base::ErrorCode::BadInput,
                          "--box: the world's heights are from {} to {}, got {} to {}", heights.bottom,
                          heights.top, box->low.z, std::int64_t{box->high.z} + 1);
    }
    const auto& area = std::get<world::ChunkArea>(blocks);
    const world::BlockPos low = world::blockPos({area.x0, area.y0}, 0),
                          high = world::blockPos({area.x1 - 1, area.y1 - 1}, 0);
    constexpr int kLast = world::kChunkSize - 1;
    return world::BlockBox{{low.x, low.y, heights.bottom}, {high.x + kLast, high.y + kLast, heights.top - 1}};
}

}  // namespace

base::Result<ExportSource> openExport(ExportOptions& options) {
    const auto content = loadContent(options.world, options.save);
    if (!content) return tl::unexpected(content.error());
    auto textures = content::loadTextures(options.resourcePack, *content->blocks, content->textures);
    if (!textures) return tl::unexpected(textures.error());
    auto save = TERRANE_TRY(openSave(options.world, options.save, store::WorldAccess::ReadOnly, *content));
    auto generator = TERRANE_TRY(makeGenerator(options.world, *content));
    const auto box = TERRANE_TRY(boxOf(options.blocks, generator.heights()));
    return ExportSource{
        content->blocks,           std::move(*textures), std::move(save), std::move(generator), box,
        threadCount(options.world)};
}

world::ChunkArea chunksOf(const world::BlockBox& box) {
    const world::ChunkPos low = world::chunkOf(box.low), high = world::chunkOf(box.high);
    return {low.x, low.y, high.x + 1, high.y + 1};
}

base::Result<void> forEachChunk(const ExportSource& source, const Progress& progress, const TakeChunk& take) {
    const world::ChunkArea area = chunksOf(source.box);
    const std::int64_t width = std::int64_t{area.x1} - area.x0, count = area.chunkCount();
    base::JobSystem jobs(source.threads);
    const auto shouldContinue = [&](std::int64_t done) {
        return !progress || progress(static_cast<std::size_t>(done), static_cast<std::size_t>(count));
    };
    std::vector<world::ChunkPos> positions;
    for (std::int64_t next = 0; next < count;) {
        if (!shouldContinue(next)) return base::fail("stopped after {} of {} chunks", next, count);
        positions.clear();
        for (; next < count && positions.size() < kExportBatch; ++next)
            positions.push_back({static_cast<std::int32_t>(area.x0 + next % width),
                                 static_cast<std::int32_t>(area.y0 + next / width)});
        const auto chunks =
            TERRANE_TRY(stream::chunksAt(positions, source.save.get(), source.generator, jobs));
        for (std::size_t k = 0; k < positions.size(); ++k) TERRANE_TRY(take(positions[k], chunks[k]));
    }
    (void)shouldContinue(count);
    return {};
}

base::Result<formats::BlockVolume> readVolume(const ExportSource& source, const Progress& progress) {
    const world::BlockBox& box = source.box;
    const std::int64_t x = std::int64_t{box.high.x} - box.low.x + 1,
                       y = std::int64_t{box.high.y} - box.low.y + 1;
    const std::int64_t z = box.high.z - box.low.z + 1;
    TERRANE_TRY(formats::checkVolumeSize(x, y, z));
    formats::BlockVolume volume{{x, y, z}, {}, {}};
    volume.cells.resize(static_cast<std::size_t>(x * y * z));
    VolumePalette palette;
    TERRANE_TRY(forEachChunk(source, progress, [&](world::ChunkPos pos, const world::Chunk& chunk) {
        return copyChunk(box, pos, chunk, palette, volume);
    }));
    volume.palette = std::move(palette.blocks);
    return volume;
}

}  // namespace terrane::io
