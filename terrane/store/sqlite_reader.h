// A world in a SQLite file that is read and left as it is, also where it cannot be written. While another
// program plays it, what that has saved last is read.
#pragma once

#include <filesystem>
#include <memory>

#include "terrane/store/rows_reader.h"
#include "terrane/store/save_file.h"

namespace terrane::store {

class SqliteReader : public RowsReader {
  public:
    // As openToRead().
    [[nodiscard]] static base::Result<std::unique_ptr<SqliteReader>> open(
        const std::filesystem::path& path, const world::BlockRegistry& registry,
        const SaveLimits& limits = {});

  private:
    using RowsReader::RowsReader;
};

// The rows alone, for a copy.
[[nodiscard]] base::Result<std::unique_ptr<ReadableRows>> openSqliteToRead(
    const std::filesystem::path& path, const world::BlockRegistry& registry);

}  // namespace terrane::store
