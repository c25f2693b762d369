// A world in one SQLite file, held by one program at a time. docs/file-format.md describes the file.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>

#include "terrane/store/chunk_reader.h"
#include "terrane/store/chunk_store.h"
#include "terrane/store/save_file.h"
#include "terrane/store/save_queue.h"

namespace terrane::store {

class SqliteStore : public ChunkStore {
  public:
    [[nodiscard]] static base::Result<std::unique_ptr<SqliteStore>> open(const std::filesystem::path& path,
                                                                         const world::BlockRegistry& registry,
                                                                         const SaveAccess& access,
                                                                         SaveLimits limits = {});
    ~SqliteStore() override;

    LoadedChunk load(world::ChunkPos pos) override;
    bool contains(world::ChunkPos pos) override;
    // A chunk with more large data than a save keeps (62 MiB) is reported and left out.
    SaveNumber save(world::ChunkPos pos, world::ChunkPtr chunk, Origin origin) override;
    std::optional<std::string> setting(std::string_view name) override;
    SaveNumber setSetting(std::string_view name, std::string value) override;
    [[nodiscard]] base::Result<void> flush() override { return queue_->flush(); }
    SaveStatus status() override { return queue_->status(); }
    const WorldIdentity& identity() const override { return file_.identity; }
    bool isPersistent() const override { return true; }

  private:
    struct Writer;
    SqliteStore(SaveFile file, std::unique_ptr<Writer> writer, SaveLimits limits);

    SaveFile file_;
    ChunkReader reader_;
    std::mutex settingsMutex_;
    std::map<std::string, std::string, std::less<>> settings_;
    std::unique_ptr<Writer> writer_;    // used by the queue's thread
    std::unique_ptr<SaveQueue> queue_;  // ends first
};

}  // namespace terrane::store
