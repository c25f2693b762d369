// For builds without libpq.
#include "terrane/store/saves/save_file.h"
#include "terrane/store/sqlite/sqlite_store.h"
#include "terrane/store_postgres/any_world.h"

namespace terrane::store_postgres {

std::string shownOf(const store::WorldLocation& location) {
    return location.kind == store::WorldLocation::Kind::Url ? "a URL" : location.text;
}

base::Result<std::unique_ptr<store::ChunkStore>> openAnyWorld(const store::WorldLocation& location,
                                                              const world::BlockRegistry& blocks,
                                                              const store::WorldRequest& request) {
    return store::openWorld(location, blocks, request);
}

base::Result<store::CheckReport> checkAnyWorld(const store::WorldLocation& location,
                                               const world::BlockRegistry& blocks) {
    const auto path = TERRANE_TRY(store::fileOf(location));
    return store::checkSave(path, blocks);
}

base::Result<std::unique_ptr<store::ReadableRows>> openAnyRowsToRead(const store::WorldLocation& location,
                                                                     const world::BlockRegistry& blocks) {
    const auto path = TERRANE_TRY(store::fileOf(location));
    return store::openSqliteToRead(path, blocks);
}

base::Result<store::Metadata> anyWorldMetadata(const store::WorldLocation& location) {
    const auto path = TERRANE_TRY(store::fileOf(location));
    return store::readSavedMetadata(path);
}

base::Result<std::unique_ptr<store::ChunkRows>> openAnyRows(const store::WorldLocation& location,
                                                            const world::BlockRegistry& blocks,
                                                            const store::SaveAccess& access) {
    const auto path = TERRANE_TRY(store::fileOf(location));
    return store::openSqliteRows(path, blocks, access);
}

}  // namespace terrane::store_postgres
