#include "terrane/store_postgres/any_world.h"

#include <utility>

#include "terrane/store/saves/save_file.h"
#include "terrane/store/sqlite/sqlite_store.h"
#include "terrane/store_postgres/postgres_store.h"
#include "terrane/store_postgres/world_database.h"

namespace terrane::store_postgres {
namespace {

bool isPostgres(const store::WorldLocation& location) {
    return location.kind == store::WorldLocation::Kind::Url && isPostgresUrl(location.text);
}

// Calls `ofDatabase` with a database's address, or `ofFile` with a file's path.
template <class OfDatabase, class OfFile>
auto open(const store::WorldLocation& location, OfDatabase ofDatabase, OfFile ofFile)
    -> decltype(ofFile(std::filesystem::path())) {
    if (isPostgres(location)) {
        const auto address = TERRANE_TRY(addressOf(location.text));
        return ofDatabase(address);
    }
    const auto path = TERRANE_TRY(store::fileOf(location));
    return ofFile(path);
}

using StoreResult = base::Result<std::unique_ptr<store::ChunkStore>>;

StoreResult openDatabase(const Address& address, const world::BlockRegistry& blocks,
                         const store::WorldRequest& request) {
    if (request.access == store::WorldAccess::ReadOnly) {
        auto saved = TERRANE_TRY(openReader(address, blocks, request.limits));
        return store::openOverlay(std::move(saved), request, address.shown);
    }
    store::SaveAccess access;
    access.create = request.create;
    access.decide = [&](const store::WorldIdentity& saved) {
        return store::compareWorld(saved, request.world, request.versionOf, address.shown);
    };
    RetryTimes times;
    // Unreadable chunks would be regenerated and their edits hidden from players: rather wait.
    if (request.sharing != store::WorldSharing::Generating) times.reading = std::chrono::minutes(10);
    auto store = PostgresStore::open(address, blocks, access, request.sharing, request.limits, times);
    if (!store) return tl::unexpected(store.error());
    TERRANE_TRY(store::requireWhole(**store, address.shown));
    return std::move(*store);
}

}  // namespace

std::string shownOf(const store::WorldLocation& location) {
    if (!isPostgres(location)) return location.text;
    const auto address = addressOf(location.text);
    return address ? address->shown : "postgresql://…";
}

StoreResult openAnyWorld(const store::WorldLocation& location, const world::BlockRegistry& blocks,
                         const store::WorldRequest& request) {
    if (!isPostgres(location)) return store::openWorld(location, blocks, request);
    const auto address = TERRANE_TRY(addressOf(location.text));
    if (!request.versionOf)
        return base::fail(base::ErrorCode::BadInput, "{}: the request names no versions of generators",
                          address.shown);
    return openDatabase(address, blocks, request);
}

base::Result<store::CheckReport> checkAnyWorld(const store::WorldLocation& location,
                                               const world::BlockRegistry& blocks) {
    return open(
        location, [&](const Address& address) { return checkDatabase(address, blocks); },
        [&](const std::filesystem::path& path) { return store::checkSave(path, blocks); });
}

base::Result<std::unique_ptr<store::ReadableRows>> openAnyRowsToRead(const store::WorldLocation& location,
                                                                     const world::BlockRegistry& blocks) {
    return open(
        location, [&](const Address& address) { return openRowsToRead(address, blocks); },
        [&](const std::filesystem::path& path) { return store::openSqliteToRead(path, blocks); });
}

base::Result<store::Metadata> anyWorldMetadata(const store::WorldLocation& location) {
    return open(
        location, [&](const Address& address) { return readDatabaseMetadata(address); },
        [&](const std::filesystem::path& path) { return store::readSavedMetadata(path); });
}

base::Result<std::unique_ptr<store::ChunkRows>> openAnyRows(const store::WorldLocation& location,
                                                            const world::BlockRegistry& blocks,
                                                            const store::SaveAccess& access) {
    return open(
        location, [&](const Address& address) { return openRows(address, blocks, access); },
        [&](const std::filesystem::path& path) { return store::openSqliteRows(path, blocks, access); });
}

}  // namespace terrane::store_postgres
