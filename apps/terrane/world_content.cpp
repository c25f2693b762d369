#include "apps/terrane/world_content.h"

#include "terrane/base/log.h"
#include "terrane/pack/installed_packs.h"
#include "terrane/pack/pack_files.h"
#include "terrane/pack/world_packs.h"
#include "terrane/store_postgres/any_world.h"

namespace terrane::app {

base::Result<pack::Content> loadContent(const WorldOptions& options, const SaveOptions& save) {
    auto packs = TERRANE_TRY(pack::readPacks(options.content));
    if (!save.world.empty()) {
        // If the world cannot be read, opening it reports the error.
        const auto metadata = store_postgres::anyWorldMetadata(store::worldLocation(save.world));
        if (metadata) TERRANE_TRY(pack::addPacks(packs, pack::rememberedPacks(*metadata)));
    }
    TERRANE_TRY(pack::addRequired(packs));
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

}  // namespace terrane::app
