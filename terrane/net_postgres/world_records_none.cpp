// World records of a build without PostgreSQL: always files.
#include "terrane/net_postgres/file_records_internal.h"

namespace terrane::net_postgres {

base::Result<WorldRecords> openRecords(const store::WorldLocation& world,
                                       const world::BlockRegistry& blocks) {
    return openFileRecords(world, blocks);
}

base::Result<std::unique_ptr<net::ServerRecords>> openRecordsToRead(const store::WorldLocation& world,
                                                                    const world::BlockRegistry& blocks) {
    auto records = TERRANE_TRY(openFileRecords(world, blocks));
    return std::move(records.records);
}

base::Result<net::History> openHistory(const store::WorldLocation& world,
                                       const world::BlockRegistry& blocks) {
    return openFileHistory(world, blocks);
}

base::Result<void> copyDatabase(const store::WorldLocation&, const world::BlockRegistry&,
                                const std::filesystem::path&, const store::CopyProgress&) {
    return base::fail(base::ErrorCode::Unsupported, "this build has no worlds in databases");
}

bool hasRecords(const store::WorldLocation& world) {
    return hasFileRecords(world);
}

base::Result<std::filesystem::path> serverFilesOf(const store::WorldLocation& world, std::uint16_t) {
    return filesBeside(world);
}

}  // namespace terrane::net_postgres
