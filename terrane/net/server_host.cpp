#include "terrane/net/server_host.h"

#include <utility>

#include "terrane/game/player_state.h"

namespace terrane::net {

base::Result<ServerHost> openServerHost(game::SessionParts parts, std::unique_ptr<ServerRecords> records,
                                        const ServerSettings& settings, const std::string& program,
                                        const ServerContent& content) {
    const store::WorldIdentity identity = parts.store->identity();
    auto graph = TERRANE_TRY(gen::makeGenerator(identity.generator, *parts.blocks, 0, content.generators));
    const WorldFingerprint fingerprint = worldFingerprint(identity, graph, *parts.blocks);
    auto people = TERRANE_TRY(People::read(*records));

    const auto tiles = std::make_shared<WrittenTiles>();
    parts.tileListener = [tiles](std::span<const world::ChunkPos> written) { noteTiles(*tiles, written); };
    ServerHost host;
    host.session = std::make_unique<game::Session>(std::move(parts));
    if (const auto time = game::savedPlayer(host.session->store()).timeDay)
        host.session->clock.timeDay = *time;
    host.records = std::move(records);
    host.people = std::make_unique<People>(std::move(people));
    auto state = TERRANE_TRY(openServer(
        {*host.session, *host.records, *host.people, program, fingerprint, content.packs}, settings, tiles));
    host.state = std::move(state);
    return host;
}

}  // namespace terrane::net
