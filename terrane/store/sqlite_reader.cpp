#include "terrane/store/sqlite_reader.h"

#include <utility>

#include "terrane/base/log.h"
#include "terrane/store/sqlite_rows.h"

namespace terrane::store {

base::Result<std::unique_ptr<ReadableRows>> openSqliteToRead(const std::filesystem::path& path,
                                                             const world::BlockRegistry& registry) {
    auto file = openToRead(path, registry);
    if (!file) return tl::unexpected(file.error());
    if (auto ended = file->database.execute("COMMIT"); !ended) return tl::unexpected(ended.error());
    if (!file->inUse.empty())
        base::logInfo("{}: {}; its saved state is read, nothing is changed", file->database.path(),
                      file->inUse);
    return std::make_unique<SqliteReadRows<ReadableRows>>(std::move(*file));
}

base::Result<std::unique_ptr<SqliteReader>> SqliteReader::open(const std::filesystem::path& path,
                                                               const world::BlockRegistry& registry,
                                                               const SaveLimits& limits) {
    auto rows = openSqliteToRead(path, registry);
    if (!rows) return tl::unexpected(rows.error());
    return std::unique_ptr<SqliteReader>(new SqliteReader(std::move(*rows), limits));
}

}  // namespace terrane::store
