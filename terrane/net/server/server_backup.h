// Backups of a running server's world: one moment of chunks, history, players and all else, written as files
// while the server goes on. The console command `backup` begins one. On the server's thread.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "terrane/base/result.h"
#include "terrane/store/sqlite/sqlite.h"

namespace terrane::net {

struct ServerState;

// A backup that another thread writes.
class RunningBackup {
  public:
    // `write` is called on that thread.
    RunningBackup(std::filesystem::path target,
                  std::function<base::Result<void>(const store::CopyProgress&)> write);
    ~RunningBackup();  // cancels it
    RunningBackup(RunningBackup&&) = default;
    RunningBackup& operator=(RunningBackup&&) = delete;

    bool isDone() const;
    base::Result<void> result();  // waits; once
    void cancel() { *isCancelled_ = true; }
    const std::filesystem::path& target() const { return target_; }

  private:
    std::filesystem::path target_;
    std::shared_ptr<std::atomic<bool>> isCancelled_ = std::make_shared<std::atomic<bool>>(false);
    std::future<base::Result<void>> done_;
};

struct ServerBackup {
    // Base path of the server's key and settings (net_postgres::serverFilesOf()). Empty: beside the world.
    std::filesystem::path files = {};
    // For a world in a database: writes the world and the server's file beside it, as of one moment at which
    // all is in the database that the server has written so far. Called on another thread.
    std::function<base::Result<void>(const std::filesystem::path& save, const store::CopyProgress&)>
        ofDatabase = {};
    std::unique_ptr<RunningBackup> running = {};
};

// Who gives a console command: operators in the chat name files only beside the world.
enum class CommandFrom : std::uint8_t { Console, Chat };

// Begins a backup of this moment, with all that is queued. `name`: a name beside the world, or a path.
// Returns the answer; the result follows in the log and in the chat of operators.
std::string startBackup(ServerState& server, const std::string& name, CommandFrom from);
// Tells the result of a backup that has ended. Call in each tick.
void continueBackup(ServerState& server);
// Ends a running backup, whose files are deleted.
void cancelBackup(ServerState& server);

}  // namespace terrane::net
