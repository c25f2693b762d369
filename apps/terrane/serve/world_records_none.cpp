// In a build without PostgreSQL.
#include "apps/terrane/serve/world_records.h"
#include "terrane/net/sqlite_records.h"

namespace terrane::app {

base::Result<WorldRecords> openRecords(const store::WorldLocation& world,
                                       const world::BlockRegistry& blocks) {
    const auto path = store::fileOf(world);
    if (!path) return tl::unexpected(path.error());
    auto records = net::SqliteRecords::open(net::serverFilePath(*path), blocks);
    if (!records) return tl::unexpected(records.error());
    return WorldRecords{std::move(*records), {}};
}

base::Result<std::unique_ptr<net::ServerRecords>> openRecordsToRead(const store::WorldLocation& world,
                                                                    const world::BlockRegistry& blocks) {
    auto records = openRecords(world, blocks);
    if (!records) return tl::unexpected(records.error());
    return std::move(records->records);
}

base::Result<net::History> openHistory(const store::WorldLocation& world,
                                       const world::BlockRegistry& blocks) {
    const auto path = store::fileOf(world);
    if (!path) return tl::unexpected(path.error());
    return net::readHistoryFile(net::serverFilePath(*path), blocks);
}

bool hasRecords(const store::WorldLocation& world) {
    const auto path = store::fileOf(world);
    std::error_code ignored;
    return path && std::filesystem::exists(net::serverFilePath(*path), ignored);
}

base::Result<std::filesystem::path> serverFilesOf(const store::WorldLocation& world, std::uint16_t) {
    auto path = store::fileOf(world);
    if (path) path->replace_extension();
    return path;
}

}  // namespace terrane::app
