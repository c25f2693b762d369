#include "apps/terrane/formats/export_source.h"

#include <algorithm>
#include <functional>
#include <unordered_map>
#include <utility>

#include "apps/terrane/open_session.h"
#include "apps/terrane/options.h"
#include "terrane/base/log.h"
#include "terrane/base/process.h"
#include "terrane/content/resource_pack.h"
#include "terrane/stream/area_chunks.h"

namespace terrane::app {
namespace {

// Chunks loaded at a time.
constexpr std::size_t kExportBatch = 64;

base::Result<world::BlockBox> parseBox(const std::string& text) {
    constexpr std::int64_t kEnd = std::int64_t{1} << 31;  // of the world, excluded
    const auto n =
        TERRANE_TRY(parseWholeNumbers(text, 6, "--box: expected X0,Y0,Z0,X1,Y1,Z1 in blocks", -kEnd, kEnd));
    if (n[0] >= n[3] || n[1] >= n[4] || n[2] >= n[5])
        return base::fail(base::ErrorCode::BadInput, "--box: \"{}\" is empty: the end X1,Y1,Z1 is excluded",
                          text);
    if (n[2] < 0 || n[5] > world::kChunkHeight)
        return base::fail(base::ErrorCode::BadInput, "--box: heights are from 0 to {}, got \"{}\"",
                          world::kChunkHeight, text);
    const auto pos = [&](std::size_t first, int less) {
        const auto at = [&](std::size_t axis) { return static_cast<std::int32_t>(n[first + axis] - less); };
        return world::BlockPos{at(0), at(1), at(2)};
    };
    return world::BlockBox{pos(0, 0), pos(3, 1)};
}

base::Result<world::BlockBox> boxOf(const ExportOptions& options) {
    if (options.area.has_value() == !options.box.empty())
        return base::fail(base::ErrorCode::BadInput, "export needs one of --area and --box");
    if (!options.area) return parseBox(options.box);
    const world::ChunkArea& area = *options.area;
    const world::BlockPos high = world::blockPos({area.x1 - 1, area.y1 - 1}, 0);
    constexpr int kLast = world::kChunkSize - 1;
    return world::BlockBox{world::blockPos({area.x0, area.y0}, 0),
                           {high.x + kLast, high.y + kLast, world::kChunkHeight - 1}};
}

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
            const auto index = static_cast<world::BlockIndex>(k + 256 * (box.low.z + z));
            const auto entry = TERRANE_TRY(palette.entryOf({chunk.block(index), chunk.blockState(index)}));
            volume
                .cells[static_cast<std::size_t>(x + volume.size.x * (y + std::int64_t{volume.size.y} * z))] =
                entry;
        }
    }
    return {};
}

}  // namespace

base::Result<ExportSource> openExport(ExportOptions& options) {
    const auto box = TERRANE_TRY(boxOf(options));
    const auto content = loadContent(options.world, options.save);
    if (!content) return tl::unexpected(content.error());
    auto textures = content::loadTextures(options.resourcePack, *content->blocks, content->textures);
    if (!textures) return tl::unexpected(textures.error());
    auto save = TERRANE_TRY(openSave(options.world, options.save, store::WorldAccess::ReadOnly, *content));
    auto generator = TERRANE_TRY(makeGenerator(options.world, *content));
    return ExportSource{content->blocks, std::move(*textures), std::move(save), std::move(generator), box};
}

world::ChunkArea chunksOf(const world::BlockBox& box) {
    const world::ChunkPos low = world::chunkOf(box.low), high = world::chunkOf(box.high);
    return {low.x, low.y, high.x + 1, high.y + 1};
}

base::Result<void> forEachChunk(const ExportOptions& options, const ExportSource& source,
                                const TakeChunk& take) {
    const world::ChunkArea area = chunksOf(source.box);
    const std::int64_t width = std::int64_t{area.x1} - area.x0, count = area.chunkCount();
    base::JobSystem jobs(threadCount(options.world));
    const base::StopSignals signals;
    base::ProgressBar bar("exporting", static_cast<std::size_t>(count));
    std::vector<world::ChunkPos> positions;
    for (std::int64_t next = 0; next < count;) {
        if (signals.stopRequested()) return base::fail("stopped after {} of {} chunks", next, count);
        positions.clear();
        for (; next < count && positions.size() < kExportBatch; ++next)
            positions.push_back({static_cast<std::int32_t>(area.x0 + next % width),
                                 static_cast<std::int32_t>(area.y0 + next / width)});
        const auto chunks =
            TERRANE_TRY(stream::chunksAt(positions, source.save.get(), source.generator, jobs));
        for (std::size_t k = 0; k < positions.size(); ++k) TERRANE_TRY(take(positions[k], chunks[k]));
        bar.set(static_cast<std::size_t>(next));
    }
    return {};
}

base::Result<formats::BlockVolume> readVolume(const ExportOptions& options, const ExportSource& source) {
    const world::BlockBox& box = source.box;
    const std::int64_t x = std::int64_t{box.high.x} - box.low.x + 1,
                       y = std::int64_t{box.high.y} - box.low.y + 1;
    const std::int64_t z = box.high.z - box.low.z + 1;
    TERRANE_TRY(formats::checkVolumeSize(x, y, z));
    formats::BlockVolume volume{{x, y, z}, {}, {}};
    volume.cells.resize(static_cast<std::size_t>(x * y * z));
    VolumePalette palette;
    TERRANE_TRY(forEachChunk(options, source, [&](world::ChunkPos pos, const world::Chunk& chunk) {
        return copyChunk(box, pos, chunk, palette, volume);
    }));
    volume.palette = std::move(palette.blocks);
    return volume;
}

}  // namespace terrane::app
