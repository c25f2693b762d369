#include "terrane/net_postgres/world_records.h"

#include "terrane/base/digest.h"
#include "terrane/base/machine.h"
#include "terrane/base/platform.h"
#include "terrane/net_postgres/file_records_internal.h"
#include "terrane/net_postgres/postgres_records.h"
#include "terrane/store/saves/save_path.h"

namespace terrane::net_postgres {
namespace {

bool isInDatabase(const store::WorldLocation& world) {
    return world.kind == store::WorldLocation::Kind::Url && store_postgres::isPostgresUrl(world.text);
}

}  // namespace

base::Result<WorldRecords> openRecords(const store::WorldLocation& world,
                                       const world::BlockRegistry& blocks) {
    if (!isInDatabase(world)) return openFileRecords(world, blocks);
    const auto address = TERRANE_TRY(store_postgres::addressOf(world.text));
    auto records = TERRANE_TRY(PostgresRecords::open(address, blocks, {base::processName(), "", ""}));
    PostgresRecords* shared = records.get();
    return WorldRecords{std::move(records), [shared](const std::string& at, const std::string& key) {
                            shared->publishAddress(at, key);
                        }};
}

base::Result<std::unique_ptr<net::ServerRecords>> openRecordsToRead(const store::WorldLocation& world,
                                                                    const world::BlockRegistry& blocks) {
    if (!isInDatabase(world)) {
        auto records = TERRANE_TRY(openFileRecords(world, blocks));
        return std::move(records.records);
    }
    const auto address = TERRANE_TRY(store_postgres::addressOf(world.text));
    auto records = TERRANE_TRY(PostgresRecords::openToRead(address, blocks, {base::processName(), "", ""}));
    return records;
}

base::Result<net::History> openHistory(const store::WorldLocation& world,
                                       const world::BlockRegistry& blocks) {
    if (!isInDatabase(world)) return openFileHistory(world, blocks);
    const auto address = TERRANE_TRY(store_postgres::addressOf(world.text));
    return readHistory(address, blocks);
}

bool hasRecords(const store::WorldLocation& world) {
    return isInDatabase(world) || hasFileRecords(world);
}

base::Result<std::filesystem::path> serverFilesOf(const store::WorldLocation& world, std::uint16_t port) {
    if (!isInDatabase(world)) return filesBeside(world);
    const auto address = TERRANE_TRY(store_postgres::addressOf(world.text));
    const auto folder = store::dataFolder(store::saveEnvironment());
    if (!folder)
        return base::fail(base::ErrorCode::NotFound, "there is no folder for the server's key: set {}",
                          base::platform::dataFolderVariables());
    std::error_code error;
    std::filesystem::create_directories(*folder, error);
    if (error)
        return base::fail(base::ErrorCode::Io, "{}: cannot be made: {}", folder->string(), error.message());
    return *folder / fmt::format("database-{:016x}-{}", base::hash64(address.shown), port);
}

}  // namespace terrane::net_postgres
