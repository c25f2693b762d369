// terrane history: lists who changed what in a shared world, even while its server runs.
#include <fmt/chrono.h>

#include <algorithm>
#include <ctime>
#include <limits>
#include <memory>
#include <optional>

#include "apps/terrane/commands/commands.h"
#include "apps/terrane/options.h"
#include "terrane/base/log.h"
#include "terrane/base/text.h"
#include "terrane/io/open_session.h"
#include "terrane/net_postgres/world_records.h"

namespace terrane::app {
namespace {

struct HistoryOptions {
    io::SaveOptions save;
    std::string player;
    std::optional<game::ColumnArea> area;
    std::optional<double> minutes;
    std::size_t limit = 100;  // edits
    bool showsEachBlock = false;
};

// The area between two corners in any order, whose columns belong to it.
game::ColumnArea areaBetween(const std::string& text) {
    using Limits = std::numeric_limits<std::int32_t>;
    const auto numbers =
        parseWholeNumbers(text, 4, "--area: expected X0,Y0,X1,Y1 in blocks", Limits::min(), Limits::max());
    if (!numbers) throw CLI::ValidationError(numbers.error().message);
    const auto [x0, x1] = std::minmax((*numbers)[0], (*numbers)[2]);
    const auto [y0, y1] = std::minmax((*numbers)[1], (*numbers)[3]);
    const auto narrow = [](std::int64_t n) { return static_cast<std::int32_t>(n); };
    return {narrow(x0), narrow(y0), narrow(x1), narrow(y1)};
}

std::string textOfTime(std::int64_t milliseconds) {
    return fmt::format("{:%F %T}", fmt::gmtime(static_cast<std::time_t>(milliseconds / 1000)));
}

// "glass", or "several" for blocks of different kinds.
std::string textOfBlocks(const net::ChangedBlock& first, const net::ChunkDifference& all,
                         const world::BlockRegistry& blocks) {
    for (const net::ChangedBlock& block : all)
        if (block.value.id != first.value.id) return "several";
    return std::string(blocks.type(first.value.id).name);
}

void printLine(const std::string& begin, world::BlockPos pos, std::string_view before, std::string_view after,
               std::size_t count) {
    base::printLine("{} at {} {} {}: {} to {}{}", begin, pos.x, pos.y, pos.z, before, after,
                    count > 1 ? fmt::format(", {} blocks", count) : "");
}

void printEdit(const net::LoggedEdit& edit, const std::string& player, const world::BlockRegistry& blocks,
               bool showsEachBlock) {
    const std::string begin = fmt::format("{} {}", textOfTime(edit.timeMs), player);
    const auto nameOf = [&](const net::ChangedBlock& block) { return blocks.type(block.value.id).name; };
    if (!showsEachBlock)
        return printLine(begin, world::blockPos(edit.chunk, edit.after.front().index),
                         textOfBlocks(edit.before.front(), edit.before, blocks),
                         textOfBlocks(edit.after.front(), edit.after, blocks), edit.after.size());
    for (std::size_t k = 0; k < edit.after.size(); ++k)
        printLine(begin, world::blockPos(edit.chunk, edit.after[k].index), nameOf(edit.before[k]),
                  nameOf(edit.after[k]), 1);
}

// The end of the last minutes: now, or the newest edit, if that has a date of the future. The server's
// stamps never go back, so after a wrong date they are ahead of the clock.
base::Result<std::int64_t> timeOfLastMinutes(const net::History& history) {
    const std::int64_t now = net::nowMs();
    const auto newest = TERRANE_TRY(net::newestEdit(history.forEachEdit, {}));
    if (!newest || newest->timeMs <= now) return now;
    const std::int64_t newestMs = std::min(newest->timeMs, net::kLastDateMs);
    if (newestMs - now > net::kWarnedOfDateMs)
        base::logWarning(
            "the newest edit of the history has a date {} ahead of the clock; the last minutes are counted "
            "from it",
            base::counted(static_cast<std::uint64_t>((newestMs - now) / 60'000), "minute"));
    return newestMs;
}

base::Result<void> printHistory(const HistoryOptions& options) {
    const auto content = TERRANE_TRY(io::loadContent({}, options.save));
    const auto& blocks = content.blocks;
    const auto history =
        TERRANE_TRY(net_postgres::openHistory(store::worldLocation(options.save.world), *blocks));
    net::EditFilter filter;
    if (!options.player.empty()) {
        filter.player = net::playerCalled(history, options.player);
        if (!filter.player)
            return base::fail(base::ErrorCode::NotFound, "no player called {} has ever joined",
                              options.player);
    }
    filter.area = options.area;
    if (options.minutes) {
        const std::int64_t now = TERRANE_TRY(timeOfLastMinutes(history));
        TERRANE_TRY(net::selectSince(filter, history.forEachEdit,
                                     now - static_cast<std::int64_t>(*options.minutes * 60000)));
    }
    std::size_t count = 0;
    bool isCut = false;
    const auto print = [&](const net::LoggedEdit& edit) -> base::Result<void> {
        if (count++ >= options.limit) {
            isCut = true;
            return base::fail("more");
        }
        printEdit(edit, net::authorOf(history, edit), *blocks, options.showsEachBlock);
        return {};
    };
    const auto done = history.forEachEdit(filter, net::EditOrder::NewestFirst, print);
    if (isCut) return {};
    return done;
}

}  // namespace

CommandEntry addHistory(CLI::App& app) {
    auto options = std::make_shared<HistoryOptions>();
    CLI::App* command =
        app.add_subcommand("history", "Show who changed what in a shared world, the newest first");
    addWorldOption(*command, options->save, "World of a server, which may run meanwhile");
    command->get_option("--world")->required();
    command->add_option("--player", options->player, "Only what this player changed, or pack:NAME")
        ->type_name("NAME");
    command
        ->add_option_function<std::string>(
            "--area", [options](const std::string& text) { options->area = areaBetween(text); },
            "Only columns from one corner to the other, in blocks")
        ->type_name("X0,Y0,X1,Y1");
    command->add_option("--minutes", options->minutes, "Only the last N minutes")->check(numberFrom(0, 1e8));
    command->add_flag("--each-block", options->showsEachBlock, "Print a line for each block of an edit");
    command->add_option("--limit", options->limit, "Maximum number of edits")
        ->check(numberFrom(1, 1e9))
        ->capture_default_str();
    return {command, [options] { return printHistory(*options); }};
}

}  // namespace terrane::app
