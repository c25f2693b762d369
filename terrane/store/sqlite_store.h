// A world in one SQLite file, used by one program at a time. docs/file-format.md describes the file.
#pragma once

#include <filesystem>
#include <memory>

#include "terrane/store/queued_store.h"
#include "terrane/store/save_file.h"

namespace terrane::store {

class SqliteStore : public QueuedStore {
  public:
    [[nodiscard]] static base::Result<std::unique_ptr<SqliteStore>> open(const std::filesystem::path& path,
                                                                         const world::BlockRegistry& registry,
                                                                         const SaveAccess& access,
                                                                         SaveLimits limits = {});

  private:
    using QueuedStore::QueuedStore;
};

// Only the rows, for a copy.
[[nodiscard]] base::Result<std::unique_ptr<ChunkRows>> openSqliteRows(const std::filesystem::path& path,
                                                                      const world::BlockRegistry& registry,
                                                                      const SaveAccess& access);

}  // namespace terrane::store
