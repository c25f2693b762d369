#include "apps/terrane/maps/static_map.h"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <mutex>
#include <utility>

#include "apps/terrane/maps/site_parts.h"
#include "terrane/base/files.h"
#include "terrane/base/job_system.h"
#include "terrane/base/log.h"
#include "terrane/base/process.h"
#include "terrane/io/map_world.h"
#include "terrane/map/map_painter.h"
#include "terrane/map/map_tile.h"
#include "terrane/map/surface_source.h"

namespace terrane::app {
namespace {

namespace fs = std::filesystem;
using map::Layer;
using map::MapTile;

// The file that identifies the world of a folder.
constexpr const char* kOriginFile = "terrane-map.txt";
// Limit: a few days of work, 300 GB.
constexpr std::int64_t kMaxTiles = 10'000'000;

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

base::Result<void> writePage(const fs::path& folder, const web::PageInfo& info) {
    for (const base::EmbeddedFile& file : web::pageFiles())
        TERRANE_TRY(base::writeFile(folder / file.path, file.data));
    return base::writeFile(folder / "world.js", web::scriptOf(info));
}

// The finest zoom, from 0 down, at which the area is no wider than a tile.
int leastZoom(const map::BlockRect& area) {
    const std::int64_t width = std::max(area.x1 - area.x0, area.y1 - area.y0);
    int zoom = 0;
    while (zoom > map::kMinZoom && map::blocksAcross(zoom) < width) --zoom;
    return zoom;
}

base::Result<std::vector<Layer>> layersOf(const std::vector<std::string>& names,
                                          const map::MapPainter& painter) {
    std::vector<Layer> layers;
    for (const std::string& name : names) {
        const auto layer = map::layerNamed(name);
        if (!layer) return base::fail(base::ErrorCode::BadInput, "--layers: there is no layer {}", name);
        if (!painter.hasLayer(*layer))
            return base::fail(base::ErrorCode::BadInput, "--layers: the generator has no {}", name);
        layers.push_back(*layer);
    }
    for (int k = 0; names.empty() && k < map::kLayerCount; ++k)
        if (painter.hasLayer(static_cast<Layer>(k))) layers.push_back(static_cast<Layer>(k));
    const bool hasBase = std::ranges::any_of(
        layers, [](Layer layer) { return layer != Layer::Height && layer != Layer::Biome; });
    if (!hasBase)
        return base::fail(
            base::ErrorCode::BadInput,
            "--layers: height and biome are drawn over day, night or isometric: name one of these");
    return layers;
}

class TileWriter {
  public:
    TileWriter(map::MapPainter& painter, const map::EditedPositions& edited, const fs::path& folder)
        : painter_(painter), edited_(edited), folder_(folder) {}

    // Does nothing if the file exists and shows no edits. Any thread.
    void write(const MapTile& tile) {
        if (hasFailed_) return;
        const fs::path file = folder_ / map::pathOf(tile);
        const std::vector<map::EditedChunk> edited = edited_.among(map::MapPainter::chunksFor(tile));
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

// False if a signal stopped it.
base::Result<bool> writeTiles(std::span<const MapTile> tiles, TileWriter& writer, base::JobSystem& jobs) {
    constexpr std::size_t kAtATime = 64;
    const base::StopSignals signals;
    base::ProgressBar bar("mapping", tiles.size());
    for (std::size_t done = 0; done < tiles.size(); done += kAtATime) {
        if (signals.stopRequested()) return false;
        const auto some = tiles.subspan(done, std::min(kAtATime, tiles.size() - done));
        TERRANE_TRY(base::parallelFor(jobs, some.size(), [&](std::size_t k) { writer.write(some[k]); }));
        TERRANE_TRY(writer.result());
        bar.set(done + some.size());
    }
    return true;
}

}  // namespace

base::Result<void> writeStaticMap(io::WorldOptions& worldOptions, const io::SaveOptions& save,
                                  const std::string& resourcePack, const world::ChunkArea& chunks,
                                  const StaticMapOptions& options) {
    const auto places = TERRANE_TRY(readPlaceFile(options.places));
    const auto world = io::openMapWorld(worldOptions, save, resourcePack);
    if (!world) return tl::unexpected(world.error());
    const game::SessionParts& opened = (*world)->parts;
    const store::WorldIdentity& identity = opened.store->identity();
    const auto spawn = TERRANE_TRY(spawnOf(**world));
    auto painter = TERRANE_TRY(io::painterOf(**world));
    const auto layers = TERRANE_TRY(layersOf(options.layers, painter));
    const map::BlockRect area = map::blocksOf(chunks);
    const int minZoom = std::min(leastZoom(area), options.maxZoom);
    if (map::countTiles(area, layers, minZoom, options.maxZoom) > kMaxTiles)
        return base::fail(base::ErrorCode::BadInput,
                          "a map has at most {} images; a lower --max-zoom needs fewer", kMaxTiles);
    const std::string origin =
        fmt::format("{} {:016x}", originOf(identity, *opened.blocks), painter.colorDigest());
    TERRANE_TRY(prepareFolder(options.folder, origin));

    web::PageInfo info{.identity = identity, .name = titleOf(save.world), .spawn = spawn};
    info.places = allPlaces(*opened.store, places);
    for (const Layer layer : layers) info.layers.emplace_back(map::nameOf(layer));
    info.minZoom = minZoom;
    info.maxZoom = options.maxZoom;
    info.isLive = false;
    info.area = area;
    TERRANE_TRY(writePage(options.folder, info));

    map::EditedPositions edited;
    for (const world::ChunkPos chunk : (*world)->edited) edited.add(chunk);
    TileWriter writer(painter, edited, options.folder);
    base::JobSystem jobs(opened.threads);
    const std::vector<MapTile> tiles = map::tilesOf(area, layers, minZoom, options.maxZoom);
    const auto isDone = TERRANE_TRY(writeTiles(tiles, writer, jobs));
    base::logInfo("{}: {} of {} images written{}", options.folder, writer.written(), tiles.size(),
                  isDone ? "; open index.html" : " before it was stopped: the same command continues");
    return {};
}

}  // namespace terrane::app
