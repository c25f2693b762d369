// A read-only store of a world in a database.
#pragma once

#include <memory>

#include "terrane/store/queued_store.h"

namespace terrane::store {

class RowsReader : public ReadableStore {
  public:
    RowsReader(std::unique_ptr<ReadableRows> rows, const SaveLimits& limits)
        : rows_(std::move(rows)), budget_(limits.entityBytes) {}

    LoadedChunk load(world::ChunkPos pos) override;
    std::vector<LoadedChunk> loadMany(std::span<const world::ChunkPos> positions) override;
    bool contains(world::ChunkPos pos) override;
    [[nodiscard]] base::Result<std::vector<world::ChunkPos>> editedChunks() override {
        return rows_->editedChunks();
    }
    std::optional<std::string> metadata(std::string_view name) override;
    const WorldIdentity& identity() const override { return rows_->identity(); }

  private:
    LoadedChunk decode(const StoredRow& row, world::ChunkPos pos);

    std::unique_ptr<ReadableRows> rows_;
    EntityBudget budget_;
};

}  // namespace terrane::store
