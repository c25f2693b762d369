// The file that a server keeps beside a world, NAME.server.sqlite: who plays there, claims, and the history
// of edits (sqlite_records.h). The world's own file has the same format with and without it.
//
// Writes are collected and made durable together, on a thread of its own, about as soon as the disk can: a
// command is acknowledged when it is durable. Functions are for one thread, the server's, but where said
// otherwise.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "terrane/store/block_id_map.h"
#include "terrane/store/file_lock.h"
#include "terrane/store/sqlite.h"

namespace terrane::net {

// The file's path for a world's: "a/home.sqlite" gives "a/home.server.sqlite".
std::filesystem::path serverFilePath(const std::filesystem::path& world);

class ServerFile {
  public:
    // Made where it is not there. Errors name the file.
    [[nodiscard]] static base::Result<std::unique_ptr<ServerFile>> open(const std::filesystem::path& path,
                                                                        const world::BlockRegistry& blocks);
    ~ServerFile();  // writes what waits
    ServerFile(const ServerFile&) = delete;
    ServerFile& operator=(const ServerFile&) = delete;

    // Called with the writer's connection, in a transaction, once or, where writing fails, again.
    using Write = std::function<base::Result<void>(store::Database&)>;
    // The number of the write; they are made in their order. Returns at once.
    std::uint64_t write(Write write);
    // All writes up to this number survive the end of the program, and of the power. Any thread.
    std::uint64_t durable() const;
    // Why the last attempt to write failed; empty after one that did not. Any thread.
    std::string problem() const;
    // Blocks until all writes so far are durable, or one attempt has failed.
    [[nodiscard]] base::Result<void> flush();

    // A connection to read by, which sees what is durable.
    store::Database& reader() { return reader_; }
    const store::BlockIdMap& ids() const { return ids_; }

  private:
    struct Parts {
        store::FileLock lock;
        store::Database writer, reader;
        store::BlockIdMap ids;
    };
    explicit ServerFile(Parts parts);
    void run();
    base::Result<void> writeAll(const std::vector<Write>& writes);

    store::FileLock lock_;
    store::Database writer_;  // of the thread
    store::Database reader_;
    store::BlockIdMap ids_;

    mutable std::mutex mutex_;
    std::condition_variable wake_, written_;
    std::vector<Write> waiting_;
    std::uint64_t queued_ = 0, durable_ = 0, attempts_ = 0;
    std::string problem_;
    bool isEnding_ = false;
    std::thread thread_;
};

}  // namespace terrane::net
