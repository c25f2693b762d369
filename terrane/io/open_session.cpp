#include "terrane/io/open_session.h"

#include "terrane/base/log.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/pack/installed_packs.h"
#include "terrane/pack/pack_files.h"
#include "terrane/store/overlay_store.h"
#include "terrane/store_postgres/any_world.h"

namespace terrane::io {

base::Result<pack::Content> loadContent(const WorldOptions& options, const SaveOptions& save) {
    auto packs = TERRANE_TRY(pack::readPacks(options.content));
    if (!save.world.empty()) {
        // If the world cannot be read, opening it reports the error.
        const auto metadata = store_postgres::anyWorldMetadata(store::worldLocation(save.world));
        if (metadata) TERRANE_TRY(pack::addPacks(packs, pack::savedPackNames(*metadata)));
    }
    TERRANE_TRY(pack::addRequiredPacks(packs));
    return pack::loadContent(std::move(packs));
}

base::Result<pack::Content> loadInstalledContent(const WorldOptions& options) {
    std::vector<std::string> installed;
    for (const std::filesystem::path& folder : pack::packFolders())
        for (const std::filesystem::path& path : pack::packsIn(folder))
            installed.push_back(path.stem().string());
    WorldOptions all = options;
    all.content.insert(all.content.end(), installed.begin(), installed.end());
    auto content = loadContent(all);
    if (content || installed.empty()) return content;
    // At least one pack is unusable: add them one by one, and log each error.
    WorldOptions good = options;
    content = loadContent(good);
    for (const std::string& name : installed) {
        WorldOptions more = good;
        more.content.push_back(name);
        auto with = loadContent(more);
        if (!with) {
            base::logWarning("{}", with.error().message);
            continue;
        }
        good = std::move(more);
        content = std::move(with);
    }
    return content;
}

base::Result<store::WorldIdentity> identityOf(const WorldOptions& options, const pack::Content& content) {
    const std::string generator = options.effectiveGenerator();
    const auto heights =
        TERRANE_TRY(gen::heightsOf(generator, *content.blocks, options.heights, content.generators));
    return store::WorldIdentity{options.effectiveSeed(), generator,
                                gen::versionOf(content.generators, generator), heights};
}

base::Result<world::Heights> heightsOfWorld(const WorldOptions& options, const SaveOptions& save,
                                            const pack::Content& content) {
    if (const auto metadata = store_postgres::anyWorldMetadata(store::worldLocation(save.world)))
        return TERRANE_TRY(store::identityFrom(*metadata, save.world)).heights;
    return TERRANE_TRY(identityOf(options, content)).heights;
}

base::Result<std::unique_ptr<store::ChunkStore>> openSave(WorldOptions& options, const SaveOptions& save,
                                                          store::WorldAccess access,
                                                          const pack::Content& content,
                                                          store::WorldSharing sharing) {
    if (!options.seedText.empty())
        base::logInfo("the seed \"{}\" is the number {}", options.seedText, options.effectiveSeed());
    if (save.world.empty()) {
        if (save.regenerate != store::Regenerate::None || save.storeGenerated)
            return base::fail(base::ErrorCode::BadInput,
                              "no world is named that could be regenerated or keep a choice");
        options.heights = TERRANE_TRY(identityOf(options, content)).heights;
        return nullptr;
    }
    // An unknown generator is an error before a save is created.
    (void)TERRANE_TRY(makeGraph(options, content));
    store::WorldRequest request;
    request.access = access;
    if (access != store::WorldAccess::ReadOnly) request.create = TERRANE_TRY(identityOf(options, content));
    request.world = {options.seed, options.generator, options.heights, save.regenerate,
                     save.followsGenerator};
    request.versionOf = [&](std::string_view name) { return gen::versionOf(content.generators, name); };
    request.sharing = sharing;
    auto opened =
        TERRANE_TRY(store_postgres::openAnyWorld(store::worldLocation(save.world), *content.blocks, request));
    if (access != store::WorldAccess::ReadOnly) pack::savePackNames(*opened, content);
    options.seed = opened->identity().seed;
    options.generator = opened->identity().generator;
    options.heights = opened->identity().heights;
    return opened;
}

base::Result<gen::GeneratorGraph> makeGraph(const WorldOptions& options, const pack::Content& content,
                                            int level) {
    return gen::makeGenerator(options.effectiveGenerator(), *content.blocks, {level, options.heights},
                              content.generators);
}

base::Result<gen::Generator> makeGenerator(const WorldOptions& options, const pack::Content& content,
                                           int level) {
    auto graph = TERRANE_TRY(makeGraph(options, content, level));
    return gen::Generator(std::move(graph), options.effectiveSeed());
}

namespace {

constexpr const char* kStoreGeneratedSetting = "store_generated";

// The option if given, which is then stored in the world; else the world's stored value, on by default.
bool storesGenerated(store::ChunkStore& store, const SaveOptions& save) {
    if (!save.storeGenerated) return store.metadata(kStoreGeneratedSetting) != "off";
    store.setMetadata(kStoreGeneratedSetting, *save.storeGenerated ? "on" : "off");
    return *save.storeGenerated;
}

}  // namespace

base::Result<OpenedWorld> openSessionParts(WorldOptions& options, const SaveOptions& save,
                                           store::WorldAccess access, store::WorldSharing sharing) {
    auto content = TERRANE_TRY(loadContent(options, save));
    auto opened = TERRANE_TRY(openSave(options, save, access, content, sharing));
    auto generators =
        TERRANE_TRY(gen::makeLevelGenerators(options.effectiveGenerator(), *content.blocks,
                                             options.effectiveSeed(), content.generators, options.heights));
    if (!opened) opened = std::make_unique<store::MemoryStore>(TERRANE_TRY(identityOf(options, content)));
    game::SessionParts parts{content.blocks, std::move(generators), std::move(opened), threadCount(options)};
    parts.storesGenerated = storesGenerated(*parts.store, save);
    return OpenedWorld{std::move(content), std::move(parts)};
}

}  // namespace terrane::io
