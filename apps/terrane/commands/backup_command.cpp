// terrane backup: a copy of a world as of one moment, while servers may run it.
#include <memory>

#include "apps/terrane/commands/commands.h"
#include "apps/terrane/options.h"
#include "apps/terrane/output_files.h"
#include "apps/terrane/world_backup.h"
#include "terrane/base/log.h"
#include "terrane/base/process.h"
#include "terrane/base/text.h"
#include "terrane/io/open_session.h"
#include "terrane/net/server/sqlite_records.h"
#include "terrane/store/saves/backup_files.h"
#include "terrane/store/saves/save_check.h"
#include "terrane/store/saves/server_file.h"

namespace terrane::app {
namespace {

struct BackupOptions {
    io::WorldOptions content;
    std::string from, to;
    bool foundDamage = false;  // result of the run
};

// Reads all of the copy, as a server does that opens it. Damaged chunks of the world stay what they are.
base::Result<void> checkFiles(BackupOptions& options, const std::filesystem::path& save) {
    const auto content =
        TERRANE_TRY(io::loadContent(options.content, {.world = save.string(), .storeGenerated = {}}));
    const auto report = TERRANE_TRY(store::checkSave(save, *content.blocks));
    for (const std::string& problem : report.fileProblems) base::logWarning("damage: {}", problem);
    if (!report.damaged.empty())
        base::logWarning("damaged chunks, as in the world: {}, the first is {}: {}",
                         report.damaged.size() + report.unlisted, store::nameOf(report.damaged.front().pos),
                         report.damaged.front().problem);
    options.foundDamage = report.isDamaged();
    const std::filesystem::path records = store::serverFilePath(save);
    std::error_code ignored;
    if (!std::filesystem::exists(records, ignored)) return {};
    const auto opened = TERRANE_TRY(net::SqliteRecords::open(records, *content.blocks));
    return net::checkRecords(*opened);
}

base::Result<void> backUp(BackupOptions& options) {
    const store::WorldLocation from = store::worldLocation(options.from),
                               to = store::worldLocation(options.to);
    if (to.kind == store::WorldLocation::Kind::Url)
        return base::fail(base::ErrorCode::BadInput,
                          "{}: a backup is a file; `terrane copy` writes databases", options.to);
    const auto target = TERRANE_TRY(store::fileOf(to));
    std::filesystem::path world;
    if (from.kind != store::WorldLocation::Kind::Url) world = TERRANE_TRY(store::fileOf(from));
    auto files = TERRANE_TRY(store::BackupFiles::create(target, world));
    const base::StopSignals signals;
    const auto progress = [&](double) { return !signals.stopRequested(); };
    TERRANE_TRY(writeBackup(from, options.content, files.save(), progress));
    TERRANE_TRY(checkFiles(options, files.save()));
    if (!world.empty()) TERRANE_TRY(files.copyServerFiles(world.replace_extension()));
    TERRANE_TRY(files.finish());
    base::printLine("the backup {} is complete", target.string());
    return {};
}

}  // namespace

CommandEntry addBackup(CLI::App& app) {
    auto options = std::make_shared<BackupOptions>();
    CLI::App* command =
        app.add_subcommand("backup", "Copy a world as of one moment into a file, also while servers run it");
    addWorldArgument(*command, "from", options->from, "The world");
    addWorldArgument(*command, "to", options->to, "A new file, NAME.sqlite");
    writesWorld(command->get_option("to"))->type_name("NAME|FILE");
    addContentOption(*command, options->content);
    command->footer(
        "The backup opens like any world. It has the players, claims and history of servers, in "
        "NAME.server.sqlite, and the server's\nkey and settings. It replaces no file. The console command "
        "`backup` of a server does the same. Exit code 1: the world has damaged chunks.");
    return {command, [options] { return backUp(*options); },
            [options] { return options->foundDamage ? 1 : 0; }};
}

}  // namespace terrane::app
