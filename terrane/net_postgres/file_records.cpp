#include "terrane/net_postgres/file_records_internal.h"

#include "terrane/net/server/sqlite_records.h"

namespace terrane::net_postgres {

base::Result<WorldRecords> openFileRecords(const store::WorldLocation& world,
                                           const world::BlockRegistry& blocks) {
    const auto path = TERRANE_TRY(store::fileOf(world));
    auto records = TERRANE_TRY(net::SqliteRecords::open(store::serverFilePath(path), blocks));
    return WorldRecords{std::move(records), {}};
}

base::Result<net::History> openFileHistory(const store::WorldLocation& world,
                                           const world::BlockRegistry& blocks) {
    const auto path = TERRANE_TRY(store::fileOf(world));
    return net::readHistoryFile(store::serverFilePath(path), blocks);
}

bool hasFileRecords(const store::WorldLocation& world) {
    const auto path = store::fileOf(world);
    std::error_code ignored;
    return path && std::filesystem::exists(store::serverFilePath(*path), ignored);
}

base::Result<std::filesystem::path> filesBeside(const store::WorldLocation& world) {
    auto path = store::fileOf(world);
    if (path) path->replace_extension();
    return path;
}

}  // namespace terrane::net_postgres
