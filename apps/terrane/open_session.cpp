#include "apps/terrane/open_session.h"

#include "terrane/base/log.h"
#include "terrane/content/built_in.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/store/memory_store.h"
#include "terrane/store_postgres/any_world.h"

namespace terrane::app {

store::WorldIdentity identityOf(const WorldOptions& options) {
    const std::string generator = options.effectiveGenerator();
    return {options.effectiveSeed(), generator, gen::generatorVersion(generator)};
}

base::Result<std::unique_ptr<store::ChunkStore>> openSave(WorldOptions& options, const SaveOptions& save,
                                                          store::WorldAccess access,
                                                          const world::BlockRegistry& blocks,
                                                          store::WorldSharing sharing) {
    if (!options.seedText.empty())
        base::logInfo("the seed \"{}\" is the number {}", options.seedText, options.effectiveSeed());
    if (save.world.empty()) {
        if (save.regenerate != store::Regenerate::None)
            return base::fail(base::ErrorCode::BadInput, "--recreate and --regenerate require --world");
        if (save.storeGenerated)
            return base::fail(base::ErrorCode::BadInput, "--store-generated requires --world");
        return nullptr;
    }
    // Before a save is made: a generator that does not exist has none.
    if (auto known = gen::makeGenerator(options.effectiveGenerator(), blocks); !known)
        return tl::unexpected(known.error());
    store::WorldRequest request;
    request.access = access;
    if (access != store::WorldAccess::ReadOnly) request.create = identityOf(options);
    request.wanted = {options.seed, options.generator, save.regenerate};
    request.versionOf = gen::generatorVersion;
    request.sharing = sharing;
    auto opened = store_postgres::openAnyWorld(store::worldLocation(save.world), blocks, request);
    if (!opened) return opened;
    options.seed = (*opened)->identity().seed;
    options.generator = (*opened)->identity().generator;
    return opened;
}

base::Result<gen::Generator> makeGenerator(const WorldOptions& options, const world::BlockRegistry& blocks) {
    auto graph = gen::makeGenerator(options.effectiveGenerator(), blocks);
    if (!graph) return tl::unexpected(graph.error());
    return gen::Generator(std::move(*graph), options.effectiveSeed());
}

namespace {

constexpr const char* kStoreGeneratedSetting = "store_generated";

// As asked for, else as the world was opened before; kept in the world.
bool storesGenerated(store::ChunkStore& store, const SaveOptions& save) {
    if (!save.storeGenerated) return store.metadata(kStoreGeneratedSetting) != "off";
    store.setMetadata(kStoreGeneratedSetting, *save.storeGenerated ? "on" : "off");
    return *save.storeGenerated;
}

}  // namespace

base::Result<game::SessionParts> openSessionParts(WorldOptions& options, const SaveOptions& save,
                                                  store::WorldAccess access, store::WorldSharing sharing) {
    auto loaded = content::loadBlocks();
    if (!loaded) return tl::unexpected(loaded.error());
    auto blocks = std::make_unique<const world::BlockRegistry>(std::move(*loaded));
    auto opened = openSave(options, save, access, *blocks, sharing);
    if (!opened) return tl::unexpected(opened.error());
    auto generators =
        gen::makeLevelGenerators(options.effectiveGenerator(), *blocks, options.effectiveSeed());
    if (!generators) return tl::unexpected(generators.error());
    if (!*opened) *opened = std::make_unique<store::MemoryStore>(identityOf(options));
    game::SessionParts parts{std::move(blocks), std::move(*generators), std::move(*opened),
                             threadCount(options)};
    parts.storesGenerated = storesGenerated(*parts.store, save);
    return parts;
}

}  // namespace terrane::app
