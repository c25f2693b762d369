// Reads chunks of an open save on any number of threads: each uses a connection of its own for the moment,
// and leaves it for the next.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "terrane/store/chunk_store.h"
#include "terrane/store/sqlite.h"

namespace terrane::store {

struct StoredChunk {
    Bytes data;
    Origin origin = Origin::Generated;
};

class ChunkReader {
  public:
    ChunkReader(std::filesystem::path path, OpenMode mode) : path_(std::move(path)), mode_(mode) {}

    // Any thread. Nothing where the save has no chunk; an error where the file is damaged.
    [[nodiscard]] base::Result<std::optional<StoredChunk>> read(world::ChunkPos pos);
    [[nodiscard]] base::Result<bool> contains(world::ChunkPos pos);

  private:
    struct Connection {
        Database database;
        Statement select, count;
    };
    base::Result<std::unique_ptr<Connection>> take();
    void giveBack(std::unique_ptr<Connection> connection);

    std::filesystem::path path_;
    OpenMode mode_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<Connection>> idle_;
};

}  // namespace terrane::store
