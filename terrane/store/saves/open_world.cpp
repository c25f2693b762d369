#include "terrane/store/saves/open_world.h"

#include <utility>

#include "terrane/base/log.h"
#include "terrane/store/overlay_store.h"
#include "terrane/store/saves/save_path.h"
#include "terrane/store/saves/server_file.h"
#include "terrane/store/saves/world_copy.h"
#include "terrane/store/sqlite/sqlite_store.h"

namespace terrane::store {
namespace {

namespace fs = std::filesystem;
using StoreResult = base::Result<std::unique_ptr<ChunkStore>>;

StoreResult openFile(const fs::path& path, const world::BlockRegistry& blocks, const WorldRequest& request) {
    SaveAccess access;
    access.create = request.create;
    access.decide = [&](const WorldIdentity& saved) -> base::Result<Regeneration> {
        if (request.sharing == WorldSharing::Alone) TERRANE_TRY(requireSavedHistory(path));
        return compareWorld(saved, request.world, request.versionOf, path.string());
    };
    auto store = TERRANE_TRY(SqliteStore::open(path, blocks, access, request.limits));
    TERRANE_TRY(requireWhole(*store, path.string()));
    return store;
}

// Up to version 0.1, named saves were in the working directory only.
void reportFormerPlace(const WorldLocation& location, const fs::path& path) {
    if (location.kind != WorldLocation::Kind::Name || path.is_absolute()) return;
    if (const auto folder = dataFolder(saveEnvironment()))
        base::logInfo("{}: opened from the working directory; move it into {} to find it from everywhere",
                      path.string(), folder->string());
}

}  // namespace

base::Result<void> requireWhole(ReadableStore& world, const std::string& where) {
    const auto mark = world.metadata(kCopyMark);
    if (!mark || !mark->starts_with(kUnfinishedCopy)) return {};
    return base::fail(base::ErrorCode::Incompatible, "{}: an unfinished copy; `terrane copy` continues it",
                      where);
}

StoreResult openOverlay(std::unique_ptr<ReadableStore> saved, const WorldRequest& request,
                        const std::string& where) {
    TERRANE_TRY(requireWhole(*saved, where));
    WorldIdentity identity = saved->identity();
    const auto by = TERRANE_TRY(compareWorld(identity, request.world, request.versionOf, where));
    if (by.chunks == Regenerate::None)
        return std::make_unique<OverlayStore>(std::move(saved), request.limits);
    if (by.chunks == Regenerate::AllButEdited)
        return base::fail(base::ErrorCode::Unsupported,
                          "{}: cannot be written, so its edits cannot be kept in a regenerated world", where);
    identity.generatorVersion = by.generatorVersion;
    return std::make_unique<MemoryStore>(std::move(identity), request.limits);
}

StoreResult openWorld(const WorldLocation& location, const world::BlockRegistry& blocks,
                      const WorldRequest& request) {
    if (!request.versionOf)
        return base::fail(base::ErrorCode::BadInput, "{}: the request names no versions of generators",
                          location.text);
    const auto path = TERRANE_TRY(fileOf(location));
    reportFormerPlace(location, path);
    if (request.access == WorldAccess::ReadOnly) {
        auto saved = TERRANE_TRY(SqliteReader::open(path, blocks, request.limits));
        return openOverlay(std::move(saved), request, path.string());
    }
    return openFile(path, blocks, request);
}

}  // namespace terrane::store
