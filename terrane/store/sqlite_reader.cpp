#include "terrane/store/sqlite_reader.h"

#include <utility>

#include "terrane/base/log.h"
#include "terrane/store/sqlite_rows.h"

namespace terrane::store {

base::Result<std::unique_ptr<ReadableRows>> openSqliteToRead(const std::filesystem::path& path,
                                                             const world::BlockRegistry& registry) {
    auto file = TERRANE_TRY(openToRead(path, registry));
    TERRANE_TRY(file.database.execute("COMMIT"));
    if (!file.inUse.empty())
        base::logInfo("{}: {}; its saved state is read, nothing is changed", file.database.path(),
                      file.inUse);
    return std::make_unique<SqliteReadRows<ReadableRows>>(std::move(file));
}

base::Result<std::unique_ptr<SqliteReader>> SqliteReader::open(const std::filesystem::path& path,
                                                               const world::BlockRegistry& registry,
                                                               const SaveLimits& limits) {
    auto rows = TERRANE_TRY(openSqliteToRead(path, registry));
    return std::unique_ptr<SqliteReader>(new SqliteReader(std::move(rows), limits));
}

}  // namespace terrane::store
