#include "terrane/store/open_store.h"

#include <system_error>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/store/memory_store.h"
#include "terrane/store/sqlite_store.h"

namespace terrane::store {

base::Result<std::unique_ptr<ChunkStore>> openStore(const std::filesystem::path& path,
                                                    const world::BlockRegistry& registry,
                                                    const SaveAccess& access, SaveLimits limits) {
    if (isWritable(path)) {
        auto store = SqliteStore::open(path, registry, access, limits);
        if (!store) return tl::unexpected(store.error());
        return std::move(*store);
    }
    std::unique_ptr<ChunkStore> store;
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored) && access.create) {
        store = std::make_unique<MemoryStore>(*access.create);
    } else {
        auto file = openToRead(path, registry);
        if (!file) return tl::unexpected(file.error());
        const auto version = access.decide ? access.decide(file->identity) : std::optional<int>();
        if (!version) return tl::unexpected(version.error());
        if (*version) {
            WorldIdentity identity = file->identity;
            identity.generatorVersion = **version;
            store = std::make_unique<MemoryStore>(std::move(identity));
        } else {
            store = std::make_unique<MemoryStore>(std::move(*file));
        }
    }
    base::logWarning("{}: cannot be written: the world runs in memory, changes are lost at the end",
                     path.string());
    return store;
}

}  // namespace terrane::store
