#include "terrane/web/map_site.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <chrono>
#include <map>
#include <random>
#include <utility>

#include "terrane/base/digest.h"
#include "terrane/base/log.h"
#include "terrane/base/machine.h"
#include "terrane/gen/generators/biomes.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/web/marker_list.h"
#include "terrane/web/tile_service.h"
#include "terrane/web/visible_changes.h"

#include <nlohmann/json.hpp>

namespace terrane::web {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kEditsEvery{250}, kPlacesEvery{1000}, kKeepAliveEvery{15000};
constexpr std::chrono::milliseconds kWorldMapTick{50};
// Minimum interval between logged problems of painting.
constexpr std::chrono::milliseconds kProblemsEvery{10000};

// The page's files, each with one text shared by all responses.
std::map<std::string, Response, std::less<>> pageAnswers() {
    std::map<std::string, Response, std::less<>> answers;
    for (const base::EmbeddedFile& file : pageFiles())
        answers.emplace(file.path, Response{.type = typeOf(file.path),
                                            .body = std::make_shared<const std::string>(file.data),
                                            .tag = fmt::format("{:016x}", base::hash64(file.data))});
    return answers;
}

}  // namespace

struct MapSite::Impl {
    // Below 2^52, since pages count in doubles.
    static std::uint64_t firstEdit() {
        std::random_device random;
        return (std::uint64_t{random()} << 32 | random()) & ((std::uint64_t{1} << 52) - 1);
    }

    // A timer that is due once per interval.
    class Every {
      public:
        explicit Every(std::chrono::milliseconds interval) : interval_(interval) {}
        bool isDue(Clock::time_point now) {
            if (now < next_) return false;
            next_ = now + interval_;
            return true;
        }

      private:
        std::chrono::milliseconds interval_;
        Clock::time_point next_{};
    };

    Impl(boost::asio::io_context& io, MapSiteParts siteParts, map::MapPainter mapPainter)
        : context(io),
          parts(std::move(siteParts)),
          page(pageAnswers()),
          painter(std::move(mapPainter)),
          jobs(parts.threads),
          tiles({painter, jobs,
                 [this](std::function<void()> work) { boost::asio::post(context, std::move(work)); },
                 parts.liveChunk, parts.tileBytes}),
          changes({painter, jobs,
                   [this](std::function<void()> work) { boost::asio::post(context, std::move(work)); },
                   [this](std::span<const world::ChunkPos> chunks) { return tiles.editedAmong(chunks); },
                   [this](std::span<const world::ChunkPos> chunks) { showChanges(chunks); }}) {}

    PageInfo info();
    Cancel answer(const Route& route, const Reply& reply);
    Cancel answerTile(const map::MapTile& tile, const Reply& reply);
    Cancel answerBlock(const BlockAt& at, const Reply& reply);
    Response blockAnswer(const BlockAt& at, std::span<const map::EditedChunk> edited);
    Response pageAnswer(const std::string& name) const;
    std::string metrics();
    void tellList(const char* name, MarkerList& list);
    void showChanges(std::span<const world::ChunkPos> chunks);
    void logProblem(const std::string& what, const base::Error& error);

    boost::asio::io_context& context;
    MapSiteParts parts;
    std::map<std::string, Response, std::less<>> page;  // by name
    map::MapPainter painter;
    base::JobSystem jobs;  // destroyed before painter and parts; TileService waits for its jobs
    TileService tiles;
    EventHub events;
    std::unique_ptr<WebServer> server;
    VisibleChanges changes;
    // Number of the last event of edits. Starts with a random number, so that numbers of different runs
    // differ, whatever the clocks say.
    std::uint64_t edits = firstEdit();
    Every editsEvery{kEditsEvery}, placesEvery{kPlacesEvery}, keepAliveEvery{kKeepAliveEvery},
        problemsEvery{kProblemsEvery};
    MarkerList players{parts.players}, places{parts.places};
    std::shared_ptr<bool> isAlive = std::make_shared<bool>(true);  // for functions posted before destruction
};

PageInfo MapSite::Impl::info() {
    PageInfo info{.identity = parts.store.identity(), .name = parts.name, .spawn = parts.spawn};
    info.places = places.places();
    for (int k = 0; k < map::kLayerCount; ++k)
        if (painter.hasLayer(static_cast<map::Layer>(k)))
            info.layers.emplace_back(map::nameOf(static_cast<map::Layer>(k)));
    info.minZoom = map::kMinZoom;
    info.maxZoom = map::kMaxZoom;
    info.edits = edits;
    return info;
}

Response MapSite::Impl::pageAnswer(const std::string& name) const {
    const auto found = page.find(name);
    return found == page.end() ? textResponse(404, "not found\n") : found->second;
}

Cancel MapSite::Impl::answerTile(const map::MapTile& tile, const Reply& reply) {
    if (!painter.hasLayer(tile.layer)) {
        reply(textResponse(404, "this world has no such layer\n"));
        return nullptr;
    }
    const auto ready = [this, reply, tile](base::Result<TileFilePtr> file) {
        if (file) {
            // The file keeps its text alive.
            return reply({.type = "image/png",
                          .body = std::shared_ptr<const std::string>(*file, &(*file)->png),
                          .tag = (*file)->tag});
        }
        if (file.error().code == base::ErrorCode::Busy)
            return reply(busyResponse(503, "too many tiles wait\n"));
        logProblem(map::pathOf(tile), file.error());
        reply(textResponse(500, "the tile cannot be painted\n"));
    };
    const TileService::Ticket ticket = tiles.request(tile, ready);
    if (ticket == 0) return nullptr;
    return [this, ticket] { tiles.cancel(ticket); };
}

Cancel MapSite::Impl::answerBlock(const BlockAt& at, const Reply& reply) {
    const world::ChunkPos chunk = world::chunkOf(world::BlockPos{at.x, at.y, 0});
    auto edited = std::make_shared<std::vector<map::EditedChunk>>(tiles.editedAmong(std::span(&chunk, 1)));
    const base::JobHandle job = jobs.submit(0, [this, at, reply, edited, alive = isAlive] {
        Response found = blockAnswer(at, *edited);
        boost::asio::post(context, [reply, found = std::move(found), alive] {
            if (*alive) reply(found);
        });
    });
    return [job] { job.cancel(); };
}

// Runs on a worker.
Response MapSite::Impl::blockAnswer(const BlockAt& at, std::span<const map::EditedChunk> edited) {
    try {
        const auto found = painter.columnInfo(at.x, at.y, edited);
        if (!found) return textResponse(500, "the place cannot be read\n");
        const nlohmann::json json = {{"x", at.x},
                                     {"y", at.y},
                                     {"z", found->topZ},
                                     {"block", parts.blocks.type(found->top).name},
                                     {"depth", found->depth},
                                     {"biome", found->biome}};
        return jsonResponse(json.dump());
    } catch (const std::exception&) {  // out of memory
        return textResponse(500, "the place cannot be read\n");
    }
}

std::string MapSite::Impl::metrics() {
    MetricsText text;
    const WebStatistics& web = server->statistics();
    text.begin("terrane_web_answers_total", "Answers to browsers, by class of status.", "counter");
    text.sample("terrane_web_answers_total", "status=\"2xx\"", static_cast<double>(web.answers2xx));
    text.sample("terrane_web_answers_total", "status=\"3xx\"", static_cast<double>(web.answers3xx));
    text.sample("terrane_web_answers_total", "status=\"4xx\"", static_cast<double>(web.answers4xx));
    text.sample("terrane_web_answers_total", "status=\"5xx\"", static_cast<double>(web.answers5xx));
    text.counter("terrane_web_sent_bytes_total", "Bytes sent to browsers.",
                 static_cast<double>(web.bytesSent));
    text.counter("terrane_web_refused_total", "Connections and requests beyond a limit.",
                 static_cast<double>(web.refused));
    text.gauge("terrane_web_connections", "Connections of browsers.", static_cast<double>(web.connections));
    text.gauge("terrane_web_listeners", "Browsers that are told of changes.",
               static_cast<double>(web.listeners));
    const TileStatistics& tile = tiles.statistics();
    text.counter("terrane_map_tiles_painted_total", "Tiles painted.", static_cast<double>(tile.painted));
    text.counter("terrane_map_paint_seconds_total", "Time that painting took.", tile.paintSeconds);
    text.counter("terrane_map_tiles_from_memory_total", "Tiles that memory had.",
                 static_cast<double>(tile.fromMemory));
    text.counter("terrane_map_tiles_cancelled_total", "Tiles nobody waited for.",
                 static_cast<double>(tile.cancelled));
    text.gauge("terrane_map_tiles_waiting", "Tiles being painted or to be painted.",
               static_cast<double>(tile.waiting));
    text.gauge("terrane_map_memory_bytes", "Tiles in memory.", static_cast<double>(tile.bytes));
    if (parts.cache)
        text.gauge("terrane_map_disk_bytes", "Surfaces on the disk.",
                   static_cast<double>(parts.cache->bytes()));
    text.gauge("process_resident_memory_bytes", "Memory of the program.",
               static_cast<double>(base::residentBytes()));
    text.counter("process_cpu_seconds_total", "CPU time of the program.", base::cpuSeconds());
    if (parts.metrics) parts.metrics(text);
    return text.text();
}

Cancel MapSite::Impl::answer(const Route& route, const Reply& reply) {
    if (const auto* tile = std::get_if<TileImage>(&route)) return answerTile(tile->tile, reply);
    if (const auto* at = std::get_if<BlockAt>(&route)) return answerBlock(*at, reply);
    if (const auto* file = std::get_if<PageFile>(&route))
        reply(pageAnswer(file->name));
    else if (std::holds_alternative<WorldInfo>(route))
        reply(jsonResponse(web::textOf(info())));
    else if (std::holds_alternative<WorldScript>(route))
        reply({.type = typeOf("world.js"), .body = std::make_shared<const std::string>(scriptOf(info()))});
    else if (std::holds_alternative<PlayerList>(route))
        reply(jsonResponse(players.text()));
    else if (std::holds_alternative<Metrics>(route))
        reply({.type = "text/plain; version=0.0.4", .body = std::make_shared<const std::string>(metrics())});
    else if (std::holds_alternative<Health>(route))
        reply(textResponse(200, "ok\n"));
    else
        reply(textResponse(404, "not found\n"));
    return nullptr;
}

// The newest event is remembered: a page finds by its number what it missed.
void MapSite::Impl::showChanges(std::span<const world::ChunkPos> chunks) {
    tiles.invalidate(chunks);
    events.publish("edits", editEvent(++edits, chunks), true);
}

void MapSite::Impl::logProblem(const std::string& what, const base::Error& error) {
    if (problemsEvery.isDue(std::chrono::steady_clock::now()))
        base::logWarning("map: {}: {}", what, error.message);
}

// Sends the list if it changed; forgets it while nobody listens.
void MapSite::Impl::tellList(const char* name, MarkerList& list) {
    if (events.count() == 0) {
        events.removeRemembered(name);
        list.sent.clear();
        return;
    }
    const std::string& text = list.text();
    if (text == list.sent) return;
    list.sent = text;
    events.publish(name, text, true);
}

base::Result<std::unique_ptr<MapSite>> MapSite::open(boost::asio::io_context& context, MapSiteParts parts,
                                                     const WebAddress& address, const WebLimits& limits) {
    const store::WorldIdentity& identity = parts.store.identity();
    auto painter = TERRANE_TRY(
        map::MapPainter::create({parts.generators, parts.blocks, parts.textures, &parts.store, parts.cache,
                                 gen::Biomes::create(identity.generator, parts.blocks, identity.seed),
                                 gen::seaLevelOf(identity.generator)}));
    const std::vector<world::ChunkPos> edited = std::move(parts.edited);
    auto impl = std::make_unique<Impl>(context, std::move(parts), std::move(painter));
    impl->tiles.addEdited(edited);
    impl->events.publish("edits", editEvent(impl->edits, {}), true);
    auto server = WebServer::open(
        context, address,
        [&site = *impl](const Route& route, const Reply& reply) { return site.answer(route, reply); },
        impl->events, limits);
    if (!server) return tl::unexpected(server.error());
    impl->server = std::move(*server);
    return std::unique_ptr<MapSite>(new MapSite(std::move(impl)));
}

MapSite::MapSite(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

MapSite::~MapSite() {
    *impl_->isAlive = false;
}

std::uint16_t MapSite::port() const {
    return impl_->server->port();
}

void MapSite::onChanged(std::span<const world::ChunkPos> chunks) {
    impl_->changes.add(chunks, impl_->tiles.edited());
    impl_->tiles.addEdited(chunks);
}

void MapSite::tick() {
    Impl& site = *impl_;
    const Clock::time_point now = Clock::now();
    if (site.editsEvery.isDue(now)) site.changes.examine();
    if (site.placesEvery.isDue(now)) {
        site.tellList("players", site.players);
        site.tellList("places", site.places);
        site.server->tick();
    }
    if (site.keepAliveEvery.isDue(now)) site.events.sendKeepAlive();
}

base::Result<void> serveWorldMap(io::MapWorld& world, const MapSettings& settings, const WorldMapLoop& loop) {
    const game::SessionParts& opened = world.parts;
    const auto spawn = TERRANE_TRY(spawnOf(world));
    const auto cache = openMapCache(settings, originOf(opened.store->identity(), *opened.blocks));
    MapSiteParts parts{opened.generators, *opened.blocks, world.textures,
                       *opened.store,     settings.title, spawn};
    parts.threads = opened.threads;
    parts.cache = cache.get();
    parts.tileBytes = static_cast<std::size_t>(settings.memoryMegabytes) * 1'000'000;
    parts.edited = world.edited;
    parts.places = [all = allPlaces(*opened.store, settings.places)] { return all; };
    boost::asio::io_context context;
    auto site = TERRANE_TRY(MapSite::open(context, std::move(parts), settings.address));
    if (loop.onOpened) loop.onOpened(site->port());
    while (!loop.stopRequested()) {
        context.restart();
        context.run_for(kWorldMapTick);
        site->tick();
    }
    return {};
}

}  // namespace terrane::web
