#include "python/src/open_world.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "terrane/pack/installed_packs.h"
#include "terrane/store/overlay_store.h"
#include "terrane/store_postgres/any_world.h"

namespace terrane::python {
namespace {

// Loads the named packs and those that a world remembers.
base::Result<pack::Content> loadContent(const std::vector<std::string>& named,
                                        const std::vector<std::string>& remembered) {
    auto packs = pack::readPacks(named);
    if (!packs) return tl::unexpected(packs.error());
    if (auto added = pack::addPacks(*packs, remembered); !added) return tl::unexpected(added.error());
    if (auto added = pack::addRequiredPacks(*packs); !added) return tl::unexpected(added.error());
    return pack::loadContent(std::move(*packs));
}

// Combines a store with the generator of its world.
base::Result<WorldSources> sourcesOf(pack::Content content, std::unique_ptr<store::ChunkStore> store,
                                     unsigned threads) {
    auto generators = generatorsOf(store->identity(), content);
    if (!generators) return tl::unexpected(generators.error());
    volume::WorldParts parts{content.blocks, std::move(*generators), std::move(store), threads};
    return WorldSources{std::move(content), std::move(parts)};
}

base::Result<store::WorldIdentity> identityOf(const NewWorld& world, const pack::Content& content) {
    const auto heights =
        TERRANE_TRY(gen::heightsOf(world.generator, *content.blocks, world.heights, content.generators));
    return store::WorldIdentity{world.seed, world.generator,
                                gen::versionOf(content.generators, world.generator), heights};
}

}  // namespace

base::Result<std::vector<std::string>> generatorNames(const std::vector<std::string>& content) {
    const auto loaded = loadContent(content, {});
    if (!loaded) return tl::unexpected(loaded.error());
    return gen::namesOf(loaded->generators);
}

base::Result<gen::LevelGenerators> generatorsOf(const store::WorldIdentity& identity,
                                                const pack::Content& content) {
    return gen::makeLevelGenerators(identity.generator, *content.blocks, identity.seed, content.generators,
                                    identity.heights);
}

unsigned threadCountOf(unsigned threads) {
    return threads > 0 ? threads : std::clamp(std::thread::hardware_concurrency(), 1u, kMaxThreads);
}

base::Result<WorldSources> generatedWorld(const NewWorld& world, unsigned threads) {
    auto content = loadContent(world.content, {});
    if (!content) return tl::unexpected(content.error());
    auto identity = identityOf(world, *content);
    if (!identity) return tl::unexpected(identity.error());
    auto store = std::make_unique<store::MemoryStore>(*identity);
    return sourcesOf(std::move(*content), std::move(store), threads);
}

base::Result<WorldSources> savedWorld(const SavedWorld& world, unsigned threads) {
    const store::WorldLocation location = store::worldLocation(world.location);
    const auto metadata = store_postgres::anyWorldMetadata(location);  // opening reports errors
    auto content =
        loadContent(world.content, metadata ? pack::savedPackNames(*metadata) : std::vector<std::string>());
    if (!content) return tl::unexpected(content.error());
    store::WorldRequest request;
    request.access = world.isReadOnly ? store::WorldAccess::ReadOnly : store::WorldAccess::ReadWrite;
    request.world = {world.seed, world.generator, world.heights};
    request.versionOf = [&](std::string_view name) { return gen::versionOf(content->generators, name); };
    if (world.isCreated) {
        const NewWorld otherwise;
        const NewWorld made{world.seed.value_or(otherwise.seed),
                            world.generator.value_or(otherwise.generator),
                            {},
                            world.heights};
        // An unknown generator is an error before a save is created.
        auto identity = identityOf(made, *content);
        if (!identity) return tl::unexpected(identity.error());
        request.create = *identity;
    }
    auto store = store_postgres::openAnyWorld(location, *content->blocks, request);
    if (!store) return tl::unexpected(store.error());
    if (!world.isReadOnly) pack::savePackNames(**store, *content);
    return sourcesOf(std::move(*content), std::move(*store), threads);
}

}  // namespace terrane::python
