// terrane map: an area from above, as generated, or as it is in a save.
#include <memory>

#include "apps/terrane/commands/commands.h"
#include "apps/terrane/open_session.h"
#include "apps/terrane/options.h"
#include "terrane/base/log.h"
#include "terrane/base/progress_bar.h"
#include "terrane/content/built_in.h"
#include "terrane/content/resource_pack.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/stream/area_chunks.h"
#include "terrane/stream/tile_rows.h"
#include "terrane/world/map_image.h"

namespace terrane::app {
namespace {

struct MapOptions {
    WorldOptions world;
    SaveOptions save;
    std::optional<int> radius;
    std::optional<world::ChunkArea> area;
    int level = 0;
    std::string output, resourcePack;
};

// 16,384² pixels: an image of 1 GiB in memory.
constexpr std::int64_t kMaxChunksInMap = 1024 * 1024;

base::Result<void> writeMap(MapOptions& options) {
    if (!options.area && !options.radius) return base::fail("map needs --radius or --area");
    const int r = options.radius.value_or(0);
    const world::ChunkArea area =
        world::areaOver(options.area.value_or(world::ChunkArea{-r, -r, r + 1, r + 1}), options.level);
    if (area.chunkCount() > kMaxChunksInMap) {
        return base::fail("{} chunks, a map shows at most {}; a higher --level shows more land",
                          area.chunkCount(), kMaxChunksInMap);
    }
    auto blocks = content::loadBlocks();
    if (!blocks) return tl::unexpected(blocks.error());
    auto save = openSave(options.world, options.save, store::WorldAccess::ReadOnly, *blocks);
    if (!save) return tl::unexpected(save.error());
    const auto generators =
        gen::makeLevelGenerators(options.world.effectiveGenerator(), *blocks, options.world.effectiveSeed());
    if (!generators) return tl::unexpected(generators.error());
    const auto generator = generators->at(options.level);
    if (!generator) return tl::unexpected(generator.error());
    const std::unique_ptr<store::ChunkStore> store = std::move(*save);  // ends before the generators
    if (store && options.level > 0) {
        stream::keepTileRows(*store, *generators, *blocks, {});
        if (auto built = stream::buildTileRows(*store); !built) return built;
    }
    auto textures = content::loadTextures(options.resourcePack, *blocks);
    if (!textures) return tl::unexpected(textures.error());
    base::JobSystem jobs(threadCount(options.world));
    base::Result<base::Image> image;
    {
        base::ProgressBar bar("mapping", static_cast<std::size_t>(area.y1 - area.y0));
        world::MapSource source{area, static_cast<std::uint8_t>(options.level),
                                [&](std::span<const world::ChunkPos> row) {
                                    return stream::chunksAt(row, store.get(), **generator, jobs);
                                }};
        if (generators->hasTint())
            source.tint = [&](world::ChunkPos pos) { return generators->tint(pos).value(); };
        image = world::drawMap(source, *blocks, *textures, jobs, [&](std::size_t rows) { bar.set(rows); });
    }
    if (!image) return tl::unexpected(image.error());
    if (auto written = base::writePng(options.output, *image); !written) return written;
    base::logInfo("{}: {} chunks, {}x{} blocks", options.output, area.chunkCount(),
                  std::int64_t{image->width} << options.level, std::int64_t{image->height} << options.level);
    return {};
}

}  // namespace

CommandEntry addMap(CLI::App& app) {
    auto options = std::make_shared<MapOptions>();
    CLI::App* command = app.add_subcommand("map", "Draw a map of an area from above into a PNG file");
    auto* radius = command->add_option("--radius", options->radius, "Chunks around 0,0: (2R+1)² of them")
                       ->check(numberFrom(0, world::kMaxChunk));
    addAreaOption(*command, options->area);
    command->get_option("--area")->excludes(radius);
    command->add_option("--level", options->level, "A pixel is 2^LEVEL blocks wide")
        ->check(numberFrom(0, world::kMaxLevel));
    addOutputOption(*command, options->output, {".png"}, "The PNG file");
    addWorldOptions(*command, options->world);
    addWorldOption(*command, options->save, "World to take the chunks from; what it lacks is generated");
    addResourcePackOption(*command, options->resourcePack);
    return {command, [options] { return writeMap(*options); }};
}

}  // namespace terrane::app
