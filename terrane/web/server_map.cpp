#include "terrane/web/server_map.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <utility>
#include <vector>

#include "terrane/net/server/server.h"
#include "terrane/net/server/server_clients.h"
#include "terrane/web/map_parts.h"
#include "terrane/web/map_site.h"

namespace terrane::web {

namespace {

constexpr int kRoof = 3;  // blocks

}  // namespace

std::vector<MapMarker> ServerPlayers::now() {
    std::vector<MapMarker> players;
    if (shown_ == ShownPlayers::None) return players;
    const std::unordered_map<game::PlayerId, Known> before = std::exchange(known_, {});
    const auto add = [&](game::PlayerId id, const std::string& name, const world::Pose& pose) {
        const world::ChunkPos chunk = world::chunkOf(pose.position);
        const auto former = before.find(id);
        const bool isNear = former != before.end() && world::chunkDistance(former->second.chunk, chunk) <= 1;
        Known known{chunk, !isNear || former->second.isHidden};
        if (shown_ == ShownPlayers::All)
            known.isHidden = false;
        else if (const auto isHidden = isUnderGround(pose))
            known.isHidden = *isHidden;
        else if (isNear)
            known.chunk = former->second.chunk;
        if (!known.isHidden) players.push_back(namedPlace(name, pose));
        known_[id] = known;
    };
    net::forEachPlaying(clients_, [&](const net::ServerClient& client) {
        add(client.player, client.name, net::poseOf(client.pose));
    });
    net::forEachElsewhere(clients_, [&](const net::KnownPlayer& player, const net::PlayerAt& at) {
        add(player.id, player.name, net::poseOf(at.pose));
    });
    return players;
}

std::optional<bool> ServerPlayers::isUnderGround(const world::Pose& pose) const {
    if (!session_.pipeline().maybeLoadChunkAt(world::chunkOf(pose.position))) return std::nullopt;
    const world::BlockPos eyes = world::blockOf(pose.position);
    int roof = 0;
    const world::Heights heights = session_.world().heights();
    for (std::int32_t z = std::max(eyes.z + 1, heights.bottom); z < heights.top && roof < kRoof; ++z)
        roof += session_.blocks().type(session_.world().block({eyes.x, eyes.y, z})).opaqueCube;
    return roof >= kRoof;
}

namespace {

void addMetrics(MetricsText& text, const net::ServerCounts& counts, const Histogram& ticks) {
    text.gauge("terrane_players", "Players on this server.", static_cast<double>(counts.players));
    text.gauge("terrane_loaded_chunks", "Chunks in memory.", static_cast<double>(counts.loadedChunks));
    text.gauge("terrane_edited_chunks", "Chunks that players changed.",
               static_cast<double>(counts.editedChunks));
    text.counter("terrane_edits_total", "Edits in the world's history.", static_cast<double>(counts.edits));
    text.histogram("terrane_tick_seconds", "Time that ticks of the game took.", ticks);
}

}  // namespace

struct ServerMap::Impl {
    explicit Impl(net::ServerEdits& ofServer) : edits(ofServer) {}

    net::ServerEdits& edits;
    Histogram ticks{{0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5}};
    std::unique_ptr<map::SurfaceCache> cache;
    std::unique_ptr<MapSite> site;
};

base::Result<std::unique_ptr<ServerMap>> ServerMap::open(boost::asio::io_context& context,
                                                         net::ServerState& server,
                                                         const MapSettings& settings, ShownPlayers players,
                                                         const world::TextureSource& textures) {
    game::Session& session = server.session;
    auto impl = std::make_unique<Impl>(server.edits);
    impl->cache = openMapCache(settings, originOf(server.offer.fingerprint.identity, session.blocks()));
    const auto& edited = server.edits.chunks.positions(0);
    MapSiteParts parts{session.generators(), session.blocks(), textures,
                       session.store(),      settings.title,   namedPlace("", server.offer.spawn)};
    parts.threads = settings.threads;
    parts.cache = impl->cache.get();
    parts.tileBytes = static_cast<std::size_t>(settings.memoryMegabytes) * 1'000'000;
    parts.edited.assign(edited.begin(), edited.end());
    parts.liveChunk = [&](world::ChunkPos pos) { return session.world().maybeChunkAt(pos); };
    parts.players = [list = ServerPlayers(server.clients, session, players)]() mutable { return list.now(); };
    parts.places = [&session, ofFile = settings.places] { return allPlaces(session.store(), ofFile); };
    parts.metrics = [&server, &ticks = impl->ticks](MetricsText& text) {
        addMetrics(text, net::countsOf(server), ticks);
    };
    auto site = TERRANE_TRY(MapSite::open(context, std::move(parts), settings.address));
    impl->site = std::move(site);
    server.edits.onChanged = [&shown = *impl->site](std::span<const world::ChunkPos> chunks) {
        shown.onChanged(chunks);
    };
    return std::unique_ptr<ServerMap>(new ServerMap(std::move(impl)));
}

ServerMap::ServerMap(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

ServerMap::~ServerMap() {
    impl_->edits.onChanged = nullptr;
}

std::uint16_t ServerMap::port() const {
    return impl_->site->port();
}

void ServerMap::tick(double milliseconds) {
    impl_->ticks.add(milliseconds / 1000);
    impl_->site->tick();
}

}  // namespace terrane::web
