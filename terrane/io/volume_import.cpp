#include "terrane/io/volume_import.h"

#include <algorithm>
#include <array>
#include <span>

#include "terrane/base/files.h"
#include "terrane/base/job_system.h"
#include "terrane/formats/file_kind.h"
#include "terrane/formats/schematic.h"
#include "terrane/formats/vox_file.h"
#include "terrane/io/import_world.h"
#include "terrane/io/open_session.h"
#include "terrane/store/chunks/structure_file.h"
#include "terrane/stream/area_chunks.h"

namespace terrane::io {
namespace {

// Chunks loaded and saved at a time.
constexpr std::size_t kPlacedBatch = 64;

base::Result<void> checkFits(const formats::BlockVolume& volume, world::BlockPos corner,
                             world::Heights heights) {
    const auto isBeyond = [](std::int32_t low, std::int32_t size) {
        return std::int64_t{low} + size - 1 > INT32_MAX;
    };
    if (isBeyond(corner.x, volume.size.x) || isBeyond(corner.y, volume.size.y))
        return base::fail(base::ErrorCode::BadInput,
                          "--at: {}×{}×{} blocks at {},{},{} reach past the end of the world", volume.size.x,
                          volume.size.y, volume.size.z, corner.x, corner.y, corner.z);
    const std::int64_t top = std::int64_t{corner.z} + volume.size.z - 1;
    if (top >= heights.bottom && corner.z < heights.top) return {};
    return base::fail(base::ErrorCode::BadInput,
                      "--at: the heights {} to {} are outside the world's, {}: nothing is imported", corner.z,
                      top, world::describe(heights));
}

// Copies the blocks of the volume in one chunk; `corner` is the volume's lowest block.
void putVolume(const formats::BlockVolume& volume, world::BlockPos corner, bool skipsAir, world::ChunkPos pos,
               world::Chunk& chunk) {
    const world::BlockPos low = world::blockPos(pos, 0);
    for (int k = 0; k < world::kChunkSize * world::kChunkSize; ++k) {
        const std::int64_t x = std::int64_t{low.x} + k % world::kChunkSize - corner.x;
        const std::int64_t y = std::int64_t{low.y} + k / world::kChunkSize - corner.y;
        if (x < 0 || x >= volume.size.x || y < 0 || y >= volume.size.y) continue;
        for (int z = 0; z < volume.size.z; ++z) {
            if (!chunk.heights().contains(corner.z + z)) continue;
            const auto cell =
                static_cast<std::size_t>(x + volume.size.x * (y + std::int64_t{volume.size.y} * z));
            const formats::BlockAndState block = volume.palette[volume.cells[cell]];
            if (skipsAir && block.id == world::kAir) continue;
            const world::BlockIndex index = k + world::kBlocksPerLayer * (corner.z + z);
            chunk.setBlock(index, block.id);
            if (block.state != 0) chunk.setBlockState(index, block.state);
        }
    }
}

void countOutside(const formats::BlockVolume& volume, int cornerZ, world::Heights heights,
                  formats::ImportCounts& counts) {
    const std::size_t layer =
        static_cast<std::size_t>(volume.size.x) * static_cast<std::size_t>(volume.size.y);
    for (int z = 0; z < volume.size.z; ++z) {
        if (heights.contains(cornerZ + z)) continue;
        std::uint64_t& count = cornerZ + z < heights.bottom ? counts.below : counts.above;
        for (const std::uint16_t cell :
             std::span(volume.cells).subspan(static_cast<std::size_t>(z) * layer, layer))
            count += volume.palette[cell].id != world::kAir ? 1 : 0;
    }
}

std::vector<world::ChunkPos> chunksOver(const formats::BlockVolume& volume, world::BlockPos corner) {
    const world::ChunkPos low = world::chunkOf(corner);
    const world::BlockPos far{corner.x + volume.size.x - 1, corner.y + volume.size.y - 1, corner.z};
    const world::ChunkPos high = world::chunkOf(far);
    std::vector<world::ChunkPos> chunks;
    for (std::int32_t y = low.y; y <= high.y; ++y)
        for (std::int32_t x = low.x; x <= high.x; ++x) chunks.push_back({x, y});
    return chunks;
}

base::Result<void> placeVolume(const VolumeOptions& options, ImportWorld& world,
                               const formats::BlockVolume& volume, const Progress& progress) {
    const auto generator = TERRANE_TRY(world.generators->at(0));
    const std::vector<world::ChunkPos> positions = chunksOver(volume, options.corner);
    base::JobSystem jobs(world.threads);
    for (std::size_t first = 0; first < positions.size(); first += kPlacedBatch) {
        if (progress && !progress(first, positions.size()))
            return base::fail("stopped after {} of {} chunks", first, positions.size());
        const auto part =
            std::span(positions).subspan(first, std::min(kPlacedBatch, positions.size() - first));
        auto chunks = TERRANE_TRY(stream::chunksAt(part, world.store.get(), *generator, jobs));
        for (std::size_t k = 0; k < part.size(); ++k) {
            putVolume(volume, options.corner, options.skipsAir, part[k], chunks[k]);
            world.store->save(part[k], std::make_shared<const world::Chunk>(std::move(chunks[k])),
                              store::Provenance::Edited);
        }
        TERRANE_TRY(world.store->flush());
    }
    if (progress) (void)progress(positions.size(), positions.size());
    return {};
}

base::Result<formats::BlockVolume> readSchematic(std::string_view bytes, const formats::BlockMapping& mapping,
                                                 formats::ImportCounts& counts) {
    const auto ids = TERRANE_TRY(formats::builtInLegacyIds());
    const auto volume = TERRANE_TRY(formats::decodeSchematic(bytes, ids));
    return formats::toBlocks(volume, mapping, counts);
}

base::Result<formats::BlockVolume> readVox(std::string_view bytes, const pack::Content& content,
                                           const formats::BlockMapping& mapping,
                                           formats::ImportCounts& counts) {
    const auto image = TERRANE_TRY(formats::decodeVox(bytes));
    const auto tops = TERRANE_TRY(world::topColors(*content.blocks, content.textures));
    auto volume = formats::toBlocks(image, mapping, *content.blocks, tops);
    std::array<std::uint64_t, 256> uses{};
    for (const std::uint8_t cell : image.cells) ++uses[cell];
    for (std::size_t k = 1; k < uses.size(); ++k)
        if (uses[k] > 0) counts.blocks[fmt::format("#{:06x}", image.colors[k] >> 8)] += uses[k];
    return volume;
}

base::Result<formats::BlockVolume> readSource(const ImportOptions& options, const pack::Content& content,
                                              VolumeFormat format, formats::ImportCounts& counts) {
    const auto mapping = TERRANE_TRY(formats::loadMapping(*content.blocks, options.mapping));
    const bool isVox = format == VolumeFormat::Vox;
    const auto explained = [&](const base::Error& error) {
        return tl::unexpected(formats::explained(options.source, isVox ? "vox" : "schem", error));
    };
    const auto bytes = base::readFile(options.source, formats::kMaxVolumeBytes);
    if (!bytes) return explained(bytes.error());
    auto volume = isVox ? readVox(*bytes, content, mapping, counts) : readSchematic(*bytes, mapping, counts);
    if (volume) return volume;
    return explained(
        {volume.error().code, fmt::format("{}: {}", options.source.string(), volume.error().message)});
}

}  // namespace

base::Result<ImportReport> importVolume(ImportOptions& options, const VolumeOptions& volumeOptions,
                                        const Progress& progress) {
    ImportReport report;
    // Read before a world is created.
    auto content = TERRANE_TRY(loadContent(options.world, options.save));
    const auto volume = TERRANE_TRY(readSource(options, content, volumeOptions.format, report.counts));
    const auto heights = TERRANE_TRY(heightsOfWorld(options.world, options.save, content));
    TERRANE_TRY(checkFits(volume, volumeOptions.corner, heights));
    auto world = TERRANE_TRY(openImportWorld(options, std::move(content)));
    TERRANE_TRY(placeVolume(volumeOptions, world, volume, progress));
    countOutside(volume, volumeOptions.corner.z, heights, report.counts);
    report.chunks = chunksOver(volume, volumeOptions.corner).size();
    return report;
}

base::Result<ImportedStructure> importStructure(const ImportOptions& options, VolumeFormat format) {
    ImportedStructure imported;
    const auto content = TERRANE_TRY(loadContent(options.world, options.save));
    const auto volume = TERRANE_TRY(readSource(options, content, format, imported.report.counts));
    const auto structure = formats::toStructure(volume, *content.blocks);
    if (!structure)
        return base::fail(structure.error().code, "{}: {}", options.source.string(),
                          structure.error().message);
    imported.bytes = TERRANE_TRY(store::encodeStructure(*structure));
    return imported;
}

}  // namespace terrane::io
