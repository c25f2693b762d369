// Records in a server's file, used by one server at a time.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "terrane/net/server/edit_log.h"
#include "terrane/net/server/server_records.h"
#include "terrane/store/chunks/block_id_map.h"
#include "terrane/store/saves/file_lock.h"
#include "terrane/store/sqlite/sqlite.h"

namespace terrane::net {

// Reads the edit history in a server's file; for its server and for other readers.
// See ServerRecords::forEachEdit().
[[nodiscard]] base::Result<void> forEachEdit(store::Database& database, const store::BlockIdMap& ids,
                                             const EditFilter& filter, EditOrder order, const UseEdit& use);

// A server's file beside the world's, NAME.server.sqlite: players, claims, and the edit history.
// The format of the world's file does not depend on it.
//
// Writes are collected and committed together by a thread of this class, about as fast as the disk allows: a
// command is acknowledged when it is durable. Functions are for the server's thread unless stated otherwise.
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
    // See ServerRecords::together().
    std::shared_ptr<void> hold();
    // All writes up to this number survive the end of the program and a power failure. Any thread.
    std::uint64_t durable() const;
    // Why the last attempt to write failed; empty if it succeeded. Any thread.
    std::string problem() const;
    // Blocks until all queued writes are durable, or an attempt failed.
    [[nodiscard]] base::Result<void> flush();

    // Opens a connection that reads the state after all writes so far, and before later ones: a transaction
    // of it has begun. The result comes once these writes are durable, or is the problem of writing them.
    std::future<base::Result<store::Database>> readFromNow();

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
    void takeWaiting(std::vector<Write>& writes, bool isLast);
    void answerMoments(std::unique_lock<std::mutex>& lock, const base::Result<void>& done);
    base::Result<void> writeAll(const std::vector<Write>& writes);

    // A request of readFromNow().
    struct Moment {
        std::uint64_t write = 0;  // the last write before it
        std::promise<base::Result<store::Database>> opened;
    };

    store::FileLock lock_;
    store::Database writer_;  // used by thread_
    store::Database reader_;
    store::OpenFiles files_;  // used by thread_
    store::BlockIdMap ids_;

    mutable std::mutex mutex_;
    std::condition_variable wake_, written_;
    std::vector<Write> waiting_;
    std::deque<Moment> moments_;
    std::uint64_t queued_ = 0, durable_ = 0, attempts_ = 0;
    std::string problem_;
    int holds_ = 0;  // results of hold() that are not released
    bool isEnding_ = false;
    std::thread thread_;
};

// Notes in a server's file that the world beside it has all edits up to this one. For a copy that nobody has
// open.
[[nodiscard]] base::Result<void> setSavedEdit(const std::filesystem::path& file, std::int64_t number);

// Begins a copy of a world in a file and of the server's file beside it, while a server may run in another
// program. The result has all that is on disk. Its history is the newer part: the edits that its world lacks
// are those after HistoryEnds::saved, as after a crash of a server.
struct SavedCopy {
    store::WriteCopy world;
    store::WriteCopy records;  // empty: no server has run the world
};
[[nodiscard]] base::Result<SavedCopy> copySaved(const std::filesystem::path& world,
                                                const world::BlockRegistry& blocks);

class SqliteRecords : public ServerRecords {
  public:
    // See ServerFile::open().
    [[nodiscard]] static base::Result<std::unique_ptr<SqliteRecords>> open(
        const std::filesystem::path& path, const world::BlockRegistry& blocks);
    explicit SqliteRecords(std::unique_ptr<ServerFile> file) : file_(std::move(file)) {}

    [[nodiscard]] base::Result<std::vector<KnownPlayer>> players() override;
    [[nodiscard]] base::Result<std::vector<game::Claim>> claims() override;
    [[nodiscard]] base::Result<std::string> text(const std::string& name) override;
    [[nodiscard]] base::Result<HistoryEnds> historyEnds() override;
    [[nodiscard]] base::Result<void> forEachEdit(const EditFilter& filter, EditOrder order,
                                                 const UseEdit& use) override;

    void addPlayer(const KnownPlayer& player) override;
    void changePlayer(game::PlayerId id, const PlayerChange& change) override;
    void addClaim(const game::Claim& claim) override;
    void removeClaim(const std::string& name) override;
    void setText(const std::string& name, const std::string& text) override;
    std::uint64_t append(const std::vector<LoggedEdit>& edits) override;
    void setSavedEdit(std::int64_t number) override;
    [[nodiscard]] std::shared_ptr<void> together() override { return file_->hold(); }

    std::uint64_t durable() const override { return file_->durable(); }
    std::string problem() const override { return file_->problem(); }
    [[nodiscard]] base::Result<void> flush() override { return file_->flush(); }
    store::WriteCopy copyFromNow() override;

    ServerFile& file() { return *file_; }

  private:
    std::unique_ptr<ServerFile> file_;
};

}  // namespace terrane::net
