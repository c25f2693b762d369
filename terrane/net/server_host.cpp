#include "terrane/net/server_host.h"

#include <utility>

#include "terrane/game/player_state.h"

namespace terrane::net {

base::Result<ServerHost> openServerHost(game::SessionParts parts, std::unique_ptr<ServerRecords> records,
                                        const ServerSettings& settings, const std::string& program,
                                        const ServerContent& content) {
    const store::WorldIdentity identity = parts.store->identity();
    auto graph = gen::makeGenerator(identity.generator, *parts.blocks, 0, content.generators);
    if (!graph) return tl::unexpected(graph.error());
    const WorldFingerprint fingerprint = worldFingerprint(identity, *graph, *parts.blocks);
    auto people = People::read(*records);
    if (!people) return tl::unexpected(people.error());

    const auto tiles = std::make_shared<WrittenTiles>();
    parts.tileListener = [tiles](std::span<const world::ChunkPos> written) { noteTiles(*tiles, written); };
    ServerHost host;
    host.session = std::make_unique<game::Session>(std::move(parts));
    if (const auto time = game::savedPlayer(host.session->store()).timeDay)
        host.session->clock.timeDay = *time;
    host.records = std::move(records);
    host.people = std::make_unique<People>(std::move(*people));
    auto state = openServer({*host.session, *host.records, *host.people, program, fingerprint, content.packs},
                            settings, tiles);
    if (!state) return tl::unexpected(state.error());
    host.state = std::move(*state);
    return host;
}

}  // namespace terrane::net
