#include "terrane/net/server/server_backup.h"

#include <utility>

#include "terrane/base/log.h"
#include "terrane/base/profile.h"
#include "terrane/game/player_state.h"
#include "terrane/net/server/server_clients.h"
#include "terrane/net/server/server_state.h"
#include "terrane/net/server/sqlite_records.h"
#include "terrane/store/saves/backup_files.h"
#include "terrane/store/saves/save_path.h"
#include "terrane/store/saves/world_list.h"
#include "terrane/store/sqlite/sqlite_store.h"

namespace terrane::net {

RunningBackup::RunningBackup(std::filesystem::path target,
                             std::function<base::Result<void>(const store::CopyProgress&)> write)
    : target_(std::move(target)),
      done_(std::async(std::launch::async, [write = std::move(write), isCancelled = isCancelled_] {
          base::setThreadName("backup");
          return write([&](double) { return !*isCancelled; });
      })) {}

RunningBackup::~RunningBackup() {
    cancel();  // the future waits for the thread
}

bool RunningBackup::isDone() const {
    return done_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

base::Result<void> RunningBackup::result() {
    return done_.get();
}

namespace {

namespace fs = std::filesystem;

// What the threads of a backup write.
struct BackupOfFile {
    store::WriteCopy world, records;
    std::int64_t newest = 0;  // the last edit of the history, which the world has
    fs::path files;           // ServerBackup::files
};

base::Result<void> writeFiles(store::BackupFiles& files, const BackupOfFile& moment,
                              const store::CopyProgress& progress) {
    const fs::path records = store::serverFilePath(files.save());
    TERRANE_TRY(moment.records(records, progress));
    TERRANE_TRY(setSavedEdit(records, moment.newest));
    TERRANE_TRY(moment.world(files.save(), progress));
    TERRANE_TRY(files.copyServerFiles(moment.files));
    return files.finish();
}

// Positions are otherwise written when players leave.
void queuePoses(ServerClients& clients) {
    forEachPlaying(clients, [&](const ServerClient& client) {
        clients.known.setPose(client.player, poseOf(client.pose));
    });
}

base::Result<fs::path> targetFrom(const std::string& name, const fs::path& folder, CommandFrom from) {
    const store::WorldLocation location = store::worldLocation(name);
    if (location.kind == store::WorldLocation::Kind::Name) {
        TERRANE_TRY(store::checkWorldName(name));
        if (const std::string like = store::saveLike(folder, name); !like.empty() && like != name)
            return base::fail(base::ErrorCode::BadInput, "\"{}\" looks like the name of the world \"{}\"",
                              name, like);
        return store::worldFile(folder, name);
    }
    if (location.kind == store::WorldLocation::Kind::Url)
        return base::fail(base::ErrorCode::BadInput, "a backup is a file, no database");
    if (from == CommandFrom::Chat)
        return base::fail(base::ErrorCode::Refused,
                          "in the chat a backup is a name; the console takes a path");
    return store::fileOf(location);
}

base::Result<void> startOfFile(ServerState& server, const std::string& name, CommandFrom from) {
    game::Session& session = server.session;
    const fs::path world = store::fileOfStore(session.store());
    if (world.empty()) return base::fail(base::ErrorCode::Unsupported, "this world is not in a file");
    fs::path files = server.backup.files;
    if (files.empty()) files = fs::path(world).replace_extension();
    const auto target = TERRANE_TRY(targetFrom(name, world.parent_path(), from));
    auto unfinished = TERRANE_TRY(store::BackupFiles::create(target, world));
    queuePoses(server.clients);
    session.pipeline().saveAll();
    game::saveTimeDay(session.store(), session.clock.timeDay);
    auto chunks = TERRANE_TRY(store::copyFromNow(session.store(), session.blocks()));
    BackupOfFile moment{std::move(chunks), server.history.records.copyFromNow(), server.history.newest,
                        files};
    const auto kept = std::make_shared<store::BackupFiles>(std::move(unfinished));
    server.backup.running = std::make_unique<RunningBackup>(
        target, [kept, moment = std::move(moment)](const store::CopyProgress& progress) {
            return writeFiles(*kept, moment, progress);
        });
    return {};
}

// The moment is one of the database, after the writes that are queued here. Chunks follow the history there:
// their edits may be undecided among the servers now.
base::Result<void> startOfDatabase(ServerState& server, const std::string& name, CommandFrom from) {
    const fs::path files = server.backup.files;
    const auto target = TERRANE_TRY(targetFrom(name, files.parent_path(), from));
    auto unfinished = TERRANE_TRY(store::BackupFiles::create(target, {}));
    queuePoses(server.clients);
    const auto kept = std::make_shared<store::BackupFiles>(std::move(unfinished));
    server.backup.running = std::make_unique<RunningBackup>(
        target,
        [kept, files, &records = server.history.records, &store = server.session.store(),
         write = server.backup.ofDatabase](const store::CopyProgress& progress) -> base::Result<void> {
            TERRANE_TRY(records.flush());
            TERRANE_TRY(store.flush());
            TERRANE_TRY(write(kept->save(), progress));
            TERRANE_TRY(kept->copyServerFiles(files));
            return kept->finish();
        });
    return {};
}

void tellOperators(ServerClients& clients, const std::string& text) {
    forEachPlaying(clients, [&](ServerClient& client) {
        if (client.role == game::Role::Operator) say(client, text);
    });
}

}  // namespace

std::string startBackup(ServerState& server, const std::string& name, CommandFrom from) {
    if (server.backup.running)
        return fmt::format("a backup is being written: {}", server.backup.running->target().string());
    const bool isShared = server.sharing.shared != nullptr;
    if (isShared && !server.backup.ofDatabase) return "this server cannot back up its database";
    const auto started = isShared ? startOfDatabase(server, name, from) : startOfFile(server, name, from);
    if (!started) return started.error().message;
    return fmt::format("backing up to {}", server.backup.running->target().string());
}

void continueBackup(ServerState& server) {
    if (!server.backup.running || !server.backup.running->isDone()) return;
    const auto running = std::exchange(server.backup.running, nullptr);
    const auto done = running->result();
    const std::string text = done ? fmt::format("the backup {} is complete", running->target().string())
                                  : fmt::format("the backup failed: {}", done.error().message);
    if (done)
        base::logInfo("{}", text);
    else
        base::logError("{}", text);
    tellOperators(server.clients, text);
}

void cancelBackup(ServerState& server) {
    if (!server.backup.running) return;
    server.backup.running->cancel();
    const auto running = std::exchange(server.backup.running, nullptr);
    if (const auto done = running->result(); !done)
        base::logError("the server stops; the backup is not complete: {}", done.error().message);
    else
        base::logInfo("the backup {} is complete", running->target().string());
}

}  // namespace terrane::net
