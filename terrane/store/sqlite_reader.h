// A world in a SQLite file that is read and left as it is, also where it cannot be written. While another
// program plays it, what that has saved last is read.
#pragma once

#include <filesystem>
#include <memory>

#include "terrane/store/chunk_reader.h"
#include "terrane/store/save_file.h"
#include "terrane/store/save_queue.h"

namespace terrane::store {

class SqliteReader : public ReadableStore {
  public:
    // As openToRead().
    [[nodiscard]] static base::Result<std::unique_ptr<SqliteReader>> open(
        const std::filesystem::path& path, const world::BlockRegistry& registry,
        const SaveLimits& limits = {});

    LoadedChunk load(world::ChunkPos pos) override;
    std::vector<LoadedChunk> loadMany(std::span<const world::ChunkPos> positions) override;
    bool contains(world::ChunkPos pos) override;
    [[nodiscard]] base::Result<std::vector<world::ChunkPos>> editedChunks() override {
        return reader_.editedChunks();
    }
    std::optional<std::string> metadata(std::string_view name) override;
    const WorldIdentity& identity() const override { return file_.identity; }

  private:
    SqliteReader(SaveFile file, const SaveLimits& limits);
    LoadedChunk decode(const StoredRow& row, world::ChunkPos pos);

    SaveFile file_;
    EntityBudget budget_;
    ChunkReader reader_;
};

}  // namespace terrane::store
