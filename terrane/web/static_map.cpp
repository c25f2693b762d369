#include "terrane/web/static_map.h"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <mutex>
#include <utility>

#include "terrane/base/files.h"
#include "terrane/base/job_system.h"
#include "terrane/io/map_world.h"
#include "terrane/map/map_painter.h"
#include "terrane/map/map_tile.h"
#include "terrane/map/surface_source.h"
#include "terrane/web/map_parts.h"

namespace terrane::web {
namespace {

namespace fs = std::filesystem;
using map::Layer;
using map::MapTile;

// The file that identifies the world of a folder.
constexpr const char* kOriginFile = "terrane-map.txt";

base::Result<void> prepareFolder(const fs::path& folder, const std::string& origin) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        return base::fail(base::ErrorCode::Io, "{}: cannot be made: {}", folder.string(), error.message());
    const fs::path file = folder / kOriginFile;
    if (fs::exists(file, error)) {
        const auto found = TERRANE_TRY(base::readFile(file));
        if (found == origin + "\n") return {};
        return base::fail(
            base::ErrorCode::Incompatible,
            "{}: has the map of another world, or one in other colors; empty it, or name another folder",
            folder.string());
    }
    if (!fs::is_empty(folder, error))
        return base::fail(base::ErrorCode::BadInput, "{}: contains other files, not a map of Terrane",
                          folder.string());
    return base::writeFile(file, origin + "\n");
}

base::Result<void> writePage(const fs::path& folder, const PageInfo& facts) {
    for (const base::EmbeddedFile& file : pageFiles())
        TERRANE_TRY(base::writeFile(folder / file.path, file.data));
    return base::writeFile(folder / "world.js", scriptOf(facts));
}

// The finest zoom, from 0 down, at which the area is no wider than a tile.
int leastZoom(const map::BlockRect& area) {
    const std::int64_t width = std::max(area.x1 - area.x0, area.y1 - area.y0);
    int zoom = 0;
    while (zoom > map::kMinZoom && map::blocksAcross(zoom) < width) --zoom;
    return zoom;
}

int minZoomOf(const StaticMapSettings& settings) {
    return std::min(leastZoom(map::blocksOf(settings.area, settings.heights)), settings.maxZoom);
}

class TileWriter {
  public:
    TileWriter(map::MapPainter& painter, const map::EditedPositions& edited, const fs::path& folder)
        : painter_(painter), edited_(edited), folder_(folder) {}

    // Does nothing if the file exists and shows no edits. Any thread.
    void write(const MapTile& tile) {
        if (hasFailed_) return;
        const fs::path file = folder_ / map::pathOf(tile);
        const std::vector<map::EditedChunk> edited = edited_.among(map::chunksFor(tile, painter_.heights()));
        std::error_code error;
        if (edited.empty() && fs::exists(file, error)) return;
        const auto png = painter_.paint(tile, edited);
        if (!png) return fail(png.error());
        fs::create_directories(file.parent_path(), error);
        if (auto written = base::writeFile(file, *png); !written) return fail(written.error());
        ++written_;
    }

    std::size_t written() const { return written_; }
    base::Result<void> result() const { return hasFailed_ ? tl::unexpected(error_) : base::Result<void>(); }

  private:
    void fail(const base::Error& error) {
        const std::lock_guard lock(mutex_);
        if (hasFailed_) return;
        error_ = error;
        hasFailed_ = true;
    }

    map::MapPainter& painter_;
    const map::EditedPositions& edited_;
    fs::path folder_;
    std::atomic<std::size_t> written_ = 0;
    std::atomic<bool> hasFailed_ = false;
    std::mutex mutex_;  // guards error_
    base::Error error_;
};

// False if `progress` stopped it.
base::Result<bool> writeTiles(std::span<const MapTile> tiles, TileWriter& writer, base::JobSystem& jobs,
                              const io::Progress& progress) {
    constexpr std::size_t kAtATime = 64;
    for (std::size_t done = 0; done < tiles.size(); done += kAtATime) {
        if (progress && !progress(done, tiles.size())) return false;
        const auto some = tiles.subspan(done, std::min(kAtATime, tiles.size() - done));
        TERRANE_TRY(base::parallelFor(jobs, some.size(), [&](std::size_t k) { writer.write(some[k]); }));
        TERRANE_TRY(writer.result());
    }
    if (progress) (void)progress(tiles.size(), tiles.size());
    return true;
}

}  // namespace

std::int64_t imageCountOf(const StaticMapSettings& settings) {
    return map::countTiles(map::blocksOf(settings.area, settings.heights), settings.layers,
                           minZoomOf(settings), settings.maxZoom);
}

base::Result<std::vector<Layer>> layersOf(const std::vector<std::string>& names,
                                          const map::MapPainter& painter) {
    std::vector<Layer> layers;
    for (const std::string& name : names) {
        const auto layer = map::layerNamed(name);
        if (!layer) return base::fail(base::ErrorCode::BadInput, "there is no layer {}", name);
        if (!painter.hasLayer(*layer))
            return base::fail(base::ErrorCode::BadInput, "the generator has no {}", name);
        layers.push_back(*layer);
    }
    for (int k = 0; names.empty() && k < map::kLayerCount; ++k)
        if (painter.hasLayer(static_cast<Layer>(k))) layers.push_back(static_cast<Layer>(k));
    const bool hasBase = std::ranges::any_of(
        layers, [](Layer layer) { return layer != Layer::Height && layer != Layer::Biome; });
    if (!hasBase)
        return base::fail(base::ErrorCode::BadInput,
                          "height and biome are drawn over day, night or isometric: name one of these");
    return layers;
}

base::Result<StaticMapWritten> writeStaticMap(io::MapWorld& world, map::MapPainter& painter,
                                              const StaticMapSettings& settings,
                                              const io::Progress& progress) {
    if (imageCountOf(settings) > kMaxImages)
        return base::fail(base::ErrorCode::BadInput, "a map has at most {} images", kMaxImages);
    const game::SessionParts& opened = world.parts;
    const store::WorldIdentity& identity = opened.store->identity();
    const auto spawn = TERRANE_TRY(spawnOf(world));
    const std::string origin =
        fmt::format("{} {:016x}", originOf(identity, *opened.blocks), painter.colorDigest());
    TERRANE_TRY(prepareFolder(settings.folder, origin));

    const map::BlockRect area = map::blocksOf(settings.area, settings.heights);
    PageInfo facts{.identity = identity, .name = settings.title, .spawn = spawn};
    facts.places = allPlaces(*opened.store, settings.places);
    for (const Layer layer : settings.layers) facts.layers.emplace_back(map::nameOf(layer));
    facts.minZoom = minZoomOf(settings);
    facts.maxZoom = settings.maxZoom;
    facts.isLive = false;
    facts.area = area;
    TERRANE_TRY(writePage(settings.folder, facts));

    map::EditedPositions edited;
    for (const world::ChunkPos chunk : world.edited) edited.add(chunk);
    TileWriter writer(painter, edited, settings.folder);
    base::JobSystem jobs(opened.threads);
    const std::vector<MapTile> tiles = map::tilesOf(area, settings.layers, facts.minZoom, settings.maxZoom);
    const auto isDone = TERRANE_TRY(writeTiles(tiles, writer, jobs, progress));
    return StaticMapWritten{writer.written(), tiles.size(), isDone};
}

}  // namespace terrane::web
