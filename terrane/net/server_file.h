// A server's file beside the world's, NAME.server.sqlite: players, claims, and the edit history
// (sqlite_records.h). The format of the world's file does not depend on it.
//
// Writes are collected and committed together by a thread of this class, about as fast as the disk allows: a
// command is acknowledged when it is durable. Functions are for the server's thread unless stated otherwise.
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

// The file's path for a world's path: "a/home.sqlite" gives "a/home.server.sqlite".
std::filesystem::path serverFilePath(const std::filesystem::path& world);

class ServerFile {
  public:
    // Opens the file, creating it if needed. Errors name the file.
    [[nodiscard]] static base::Result<std::unique_ptr<ServerFile>> open(const std::filesystem::path& path,
                                                                        const world::BlockRegistry& blocks);
    ~ServerFile();  // commits queued writes, in one attempt
    ServerFile(const ServerFile&) = delete;
    ServerFile& operator=(const ServerFile&) = delete;

    // Called with the writer's connection, inside a transaction; called again if writing failed.
    using Write = std::function<base::Result<void>(store::Database&)>;
    // Queues a write and returns its number; writes run in order. Does not block.
    std::uint64_t write(Write write);
    // All writes up to this number survive the end of the program and a power failure. Any thread.
    std::uint64_t durable() const;
    // Why the last attempt to write failed; empty if it succeeded. Any thread.
    std::string problem() const;
    // Blocks until all queued writes are durable, or an attempt failed.
    [[nodiscard]] base::Result<void> flush();

    // A read-only connection, which sees the durable state.
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
    store::Database writer_;  // used by thread_
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
