// A read-only store of a world in a SQLite file, which need not be writable. While another program plays the
// world, its last saved state is read.
#pragma once

#include <filesystem>
#include <memory>

#include "terrane/store/rows_reader.h"
#include "terrane/store/save_file.h"

namespace terrane::store {

class SqliteReader : public RowsReader {
  public:
    // See openToRead().
    [[nodiscard]] static base::Result<std::unique_ptr<SqliteReader>> open(
        const std::filesystem::path& path, const world::BlockRegistry& registry,
        const SaveLimits& limits = {});

  private:
    using RowsReader::RowsReader;
};

// Only the rows, for a copy.
[[nodiscard]] base::Result<std::unique_ptr<ReadableRows>> openSqliteToRead(
    const std::filesystem::path& path, const world::BlockRegistry& registry);

}  // namespace terrane::store
