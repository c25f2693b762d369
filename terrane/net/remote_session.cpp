#include "terrane/net/remote_session.h"

#include <utility>

namespace terrane::net {

base::Result<gen::Generator> offeredGenerator(const WorldOffer& offer, const world::BlockRegistry& blocks,
                                              const gen::GeneratorCatalogue& generators) {
    store::WorldIdentity own{offer.world.identity.seed, {}, 0};
    auto graph = gen::makeGenerator(offer.world.identity.generator, blocks, 0, generators);
    WorldFingerprint client{own, 0, blocksHash(blocks)};
    if (graph) {
        own.generator = offer.world.identity.generator;
        own.generatorVersion = gen::versionOf(generators, own.generator);
        client = worldFingerprint(own, *graph, blocks);
    }
    const std::string difference = differenceOf(offer.world, client);
    // A missing generator shows up as a difference, unless the server claims the values of a missing one.
    if (!graph && difference.empty()) return tl::unexpected(graph.error());
    if (!difference.empty()) return base::fail(base::ErrorCode::Incompatible, "{}", difference);
    return gen::Generator(std::move(*graph), own.seed);
}

base::Result<RemoteSessionParts> remoteSessionParts(const store::WorldIdentity& identity,
                                                    std::shared_ptr<const world::BlockRegistry> blocks,
                                                    unsigned threads,
                                                    const gen::GeneratorCatalogue& generators) {
    auto forSession = gen::makeLevelGenerators(identity.generator, *blocks, identity.seed, generators);
    auto forStore = gen::makeLevelGenerators(identity.generator, *blocks, identity.seed, generators);
    if (!forSession || !forStore) return tl::unexpected((!forSession ? forSession : forStore).error());
    auto store = std::make_unique<RemoteStore>(identity, std::move(*forStore));
    RemoteStore* const told = store.get();
    game::SessionParts parts{std::move(blocks), std::move(*forSession), std::move(store), threads};
    parts.storesGenerated = false;
    return RemoteSessionParts{std::move(parts), told};
}

}  // namespace terrane::net
