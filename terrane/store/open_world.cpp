#include "terrane/store/open_world.h"

#include <cassert>
#include <system_error>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/store/memory_store.h"
#include "terrane/store/overlay_store.h"
#include "terrane/store/sqlite_reader.h"
#include "terrane/store/sqlite_store.h"

namespace terrane::store {
namespace {

namespace fs = std::filesystem;
using StoreResult = base::Result<std::unique_ptr<ChunkStore>>;

StoreResult openFile(const fs::path& path, const world::BlockRegistry& blocks, const WorldRequest& request) {
    SaveAccess access{.create = request.create, .decide = {}};
    access.decide = [&](const WorldIdentity& saved) {
        return compareWorld(saved, request.wanted, request.versionOf, path.string());
    };
    auto store = SqliteStore::open(path, blocks, access, request.limits);
    if (!store) return tl::unexpected(store.error());
    return std::move(*store);
}

StoreResult openInMemory(const fs::path& path, const world::BlockRegistry& blocks,
                         const WorldRequest& request) {
    auto saved = SqliteReader::open(path, blocks, request.limits);
    if (!saved) return tl::unexpected(saved.error());
    WorldIdentity identity = (*saved)->identity();
    const auto by = compareWorld(identity, request.wanted, request.versionOf, path.string());
    if (!by) return tl::unexpected(by.error());
    if (by->chunks == Regenerate::None)
        return std::make_unique<OverlayStore>(std::move(*saved), request.limits);
    if (by->chunks == Regenerate::AllButEdited)
        return base::fail(base::ErrorCode::Unsupported,
                          "{}: cannot be written, so its edits cannot be kept in a world made anew",
                          path.string());
    identity.generatorVersion = by->generatorVersion;
    return std::make_unique<MemoryStore>(std::move(identity), request.limits);
}

StoreResult openUnwritable(const fs::path& path, const world::BlockRegistry& blocks,
                           const WorldRequest& request) {
    std::error_code ignored;
    const bool isNew = !fs::exists(path, ignored) && request.create;
    StoreResult store = isNew ? std::make_unique<MemoryStore>(*request.create, request.limits)
                              : openInMemory(path, blocks, request);
    if (store) {
        base::logWarning("{}: cannot be written: the world runs in memory, changes are lost at the end",
                         path.string());
    }
    return store;
}

}  // namespace

StoreResult openWorld(const WorldLocation& location, const world::BlockRegistry& blocks,
                      const WorldRequest& request) {
    assert(request.versionOf && "the generators of the program decide whether a world fits");
    const auto path = fileOf(location);
    if (!path) return tl::unexpected(path.error());
    if (request.access == WorldAccess::ReadOnly) return openInMemory(*path, blocks, request);
    if (request.access == WorldAccess::ReadWriteOrMemory && !isWritable(*path))
        return openUnwritable(*path, blocks, request);
    return openFile(*path, blocks, request);
}

}  // namespace terrane::store
