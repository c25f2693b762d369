// terrane copy: copies a world, from and to a file or a database.
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/terrane/commands/commands.h"
#include "apps/terrane/options.h"
#include "apps/terrane/output_files.h"
#include "terrane/base/log.h"
#include "terrane/base/process.h"
#include "terrane/base/text.h"
#include "terrane/io/open_session.h"
#include "terrane/net/server/server_records.h"
#include "terrane/net_postgres/world_records.h"
#include "terrane/store/saves/world_copy.h"
#include "terrane/store_postgres/any_world.h"

namespace terrane::app {
namespace {

struct CopyOptions {
    std::string from, to;
    bool json = false;
    bool foundDamage = false;  // result of the run
};

void print(const CopyOptions& options, const store::CopyReport& report) {
    if (options.json) {
        const nlohmann::json line = {{"chunks", report.rows},
                                     {"bytes", report.bytes},
                                     {"copied", report.copied},
                                     {"damaged", report.damaged},
                                     {"digest", report.digest}};
        std::cout << line.dump() << '\n';
        return;
    }
    base::printLine("{} chunks, {} bytes, {} of them copied now; compared: equal, digest {}", report.rows,
                    report.bytes, report.copied, report.digest);
    if (report.damaged > 0)
        base::printLine("{} damaged chunks were left out, the first is {}", report.damaged,
                        report.firstDamage);
}

// Copies players, claims and the history, if servers of the world left any.
base::Result<void> copyServers(const CopyOptions& options, const world::BlockRegistry& blocks) {
    const store::WorldLocation from = store::worldLocation(options.from),
                               to = store::worldLocation(options.to);
    if (!net_postgres::hasRecords(from)) return {};
    const auto source = TERRANE_TRY(net_postgres::openRecordsToRead(from, blocks));
    const auto players = TERRANE_TRY(source->players());
    if (players.empty()) return {};
    const auto target = TERRANE_TRY(net_postgres::openRecords(to, blocks));
    const auto copied = net::copyRecords(*source, *target.records);
    if (!copied)
        return base::fail(copied.error().code, "{}: {}", store_postgres::shownOf(from),
                          copied.error().message);
    base::logInfo("{} players, {} claims and {} edits of the history copied", copied->players, copied->claims,
                  copied->edits);
    return {};
}

// The records of servers are copied first: if a running server prevents it, the copy is unfinished and can
// continue later.
base::Result<void> copy(CopyOptions& options) {
    const auto content = TERRANE_TRY(io::loadContent({}, {.world = options.from, .storeGenerated = {}}));
    const world::BlockRegistry& blocks = *content.blocks;
    auto from = TERRANE_TRY(store_postgres::openAnyRowsToRead(store::worldLocation(options.from), blocks));
    const auto total = TERRANE_TRY(from->rowCount());
    auto to = TERRANE_TRY(
        store_postgres::openAnyRows(store::worldLocation(options.to), blocks, store::accessOfCopy(*from)));
    const auto lastKey = TERRANE_TRY(store::beginCopy(*from, *to));
    TERRANE_TRY(copyServers(options, blocks));
    const base::StopSignals signals;
    // Rows are copied, then compared.
    base::ProgressBar bar("copying", static_cast<std::size_t>(2 * total));
    const auto report = TERRANE_TRY(store::copyWorld(*from, *to, lastKey, [&](std::uint64_t rows) {
        bar.set(static_cast<std::size_t>(std::min(rows, 2 * total)));
        return !signals.stopRequested();
    }));
    options.foundDamage = report.damaged > 0;
    print(options, report);
    return {};
}

}  // namespace

CommandEntry addCopy(CLI::App& app) {
    auto options = std::make_shared<CopyOptions>();
    CLI::App* command =
        app.add_subcommand("copy", "Copy a world; exit code 1 if damaged chunks were left out");
    addWorldArgument(*command, "from", options->from, "The world");
    addWorldArgument(*command, "to", options->to, "A new world, or an unfinished copy");
    writesWorld(command->get_option("to"));
    command->add_flag("--json", options->json, "Print the result as JSON");
    return {command, [options] { return copy(*options); },
            [options] { return options->foundDamage ? 1 : 0; }};
}

}  // namespace terrane::app
