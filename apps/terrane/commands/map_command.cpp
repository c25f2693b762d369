// terrane map: draws an area from above, as generated or as saved.
#include <memory>
#include <optional>

#include "apps/terrane/commands/commands.h"
#include "apps/terrane/map_options.h"
#include "apps/terrane/options.h"
#include "terrane/base/log.h"
#include "terrane/io/map_world.h"
#include "terrane/map/area_image.h"

namespace terrane::app {
namespace {

struct MapOptions {
    io::WorldOptions world;
    io::SaveOptions save;
    AreaOptions chunks;
    std::optional<int> level;
    std::string output, resourcePack;
    MapSiteOptions site;
    StaticMapOptions files;
};

// Limit: 16,384² pixels, an image of 1 GiB in memory.
constexpr std::int64_t kMaxChunksInMap = 1024 * 1024;
// Without --level, the finest level whose image has at most 4,096² pixels: seconds, and some megabytes.
constexpr std::int64_t kChunksOfChosenLevel = 256 * 256;

base::Result<world::ChunkArea> chosenArea(const MapOptions& options) {
    const auto area = areaOf(options.chunks);
    if (!area) return base::fail(base::ErrorCode::BadInput, "map needs --radius or --area");
    return *area;
}

int chosenLevel(const MapOptions& options, const world::ChunkArea& area) {
    if (options.level) return *options.level;
    int level = 0;
    while (level < world::kMaxLevel && world::areaOver(area, level).chunkCount() > kChunksOfChosenLevel)
        ++level;
    if (level > 0)
        base::logInfo("level {} is drawn: a pixel is {} blocks wide; --level 0 draws each block", level,
                      std::int64_t{1} << level);
    return level;
}

base::Result<void> writeMap(MapOptions& options) {
    const auto chosen = TERRANE_TRY(chosenArea(options));
    const int level = chosenLevel(options, chosen);
    const world::ChunkArea area = world::areaOver(chosen, level);
    if (area.chunkCount() > kMaxChunksInMap) {
        return base::fail(
            "{} chunks of level {}, a map shows at most {}; {}", area.chunkCount(), level, kMaxChunksInMap,
            level < world::kMaxLevel ? "a higher --level shows more land" : "choose a smaller --area");
    }
    const auto world = io::openMapWorld(options.world, options.save, options.resourcePack);
    if (!world) return tl::unexpected(world.error());
    auto painter = TERRANE_TRY(io::painterOf(**world));
    map::EditedPositions edited;
    for (const world::ChunkPos chunk : (*world)->edited) edited.add(chunk);
    base::JobSystem jobs((*world)->parts.threads);
    base::Result<base::Image> image;
    {
        const map::ColumnRect rect = map::columnsOf(area, level);
        base::ProgressBar bar("mapping", static_cast<std::size_t>(rect.height));
        image = map::drawArea(painter, rect, edited, jobs, [&](int rows) {
            bar.set(static_cast<std::size_t>(rows));
            return true;
        });
    }
    if (!image) return tl::unexpected(image.error());
    TERRANE_TRY(base::writePng(options.output, *image));
    base::logInfo("{}: {} chunks, {}x{} blocks", options.output, area.chunkCount(),
                  std::int64_t{image->width} << level, std::int64_t{image->height} << level);
    return {};
}

// Fails for options that the chosen kind of map does not have.
base::Result<void> checkOptions(const MapOptions& options, const CLI::App& command) {
    const int ways = !options.output.empty() + !options.site.http.empty() + !options.files.folder.empty();
    if (ways != 1)
        return base::fail(base::ErrorCode::BadInput,
                          "map needs one of -o FILE, --http PORT and --tiles FOLDER");
    const auto belongs = [&](std::string_view name) {
        if (!options.output.empty()) return name == "--radius" || name == "--area" || name == "--level";
        if (!options.site.http.empty()) return name.starts_with("--map-");
        return name == "--radius" || name == "--area" || name == "--max-zoom" || name == "--layers" ||
               name == "--map-places";
    };
    for (const char* name : {"--radius", "--area", "--level", "--max-zoom", "--layers", "--map-places",
                             "--map-disk", "--map-host", "--map-memory"}) {
        const CLI::Option* option = command.get_option_no_throw(name);
        if (option && !option->empty() && !belongs(name))
            return base::fail(base::ErrorCode::BadInput, "{} cannot be used with {}", name,
                              !options.output.empty()      ? "-o"
                              : !options.site.http.empty() ? "--http"
                                                           : "--tiles");
    }
    return {};
}

base::Result<void> runMap(MapOptions& options, const CLI::App& command) {
    TERRANE_TRY(checkOptions(options, command));
    if (!options.output.empty()) return writeMap(options);
    if (!options.site.http.empty())
        return showMap(options.world, options.save, options.resourcePack, options.site);
    const auto area = TERRANE_TRY(chosenArea(options));
    options.files.places = options.site.places;
    return writeStaticMap(options.world, options.save, options.resourcePack, area, options.files);
}

}  // namespace

CommandEntry addMap(CLI::App& app) {
    auto options = std::make_shared<MapOptions>();
    CLI::App* command = app.add_subcommand(
        "map", "Draw a map of an area into a PNG file or a folder of files, or show it to browsers");
    addAreaOptions(*command, options->chunks, world::kMaxChunk, "Chunks around 0,0: (2R+1)² of them");
    command
        ->add_option(
            "--level", options->level,
            "A pixel is 2^LEVEL blocks wide (default: the first whose image has at most 4096x4096 pixels)")
        ->check(numberFrom(0, world::kMaxLevel));
    addOutputOption(*command, options->output, {".png"}, "The PNG file");
    command->get_option("--output")->required(false);
    addWorldOptions(*command, options->world);
    addWorldOption(*command, options->save, "World to read; missing chunks are generated");
    addResourcePackOption(*command, options->resourcePack);
    addMapSiteOptions(*command, options->site, false);
    addStaticMapOptions(*command, options->files);
    return {command, [options, command] { return runMap(*options, *command); }};
}

}  // namespace terrane::app
