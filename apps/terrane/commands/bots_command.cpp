// terrane bots: runs simulated players, for load tests and as an example of a client.
#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <deque>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/terrane/commands/commands.h"
#include "apps/terrane/options.h"
#include "apps/terrane/output_files.h"
#include "terrane/base/files.h"
#include "terrane/base/log.h"
#include "terrane/base/machine.h"
#include "terrane/base/process.h"
#include "terrane/base/statistics.h"
#include "terrane/net/client/bot.h"

namespace terrane::app {
namespace {

struct BotsOptions {
    std::vector<std::string> servers;
    int count = 10;
    double seconds = 60;
    double joinsPerSecond = 50;
    std::string acknowledged;  // file; empty: none
    net::BotSettings bots;
};

std::uint64_t receivedBytes(const std::deque<net::Bot>& bots) {
    std::uint64_t bytes = 0;
    for (const net::Bot& bot : bots) bytes += bot.link().receivedBytes();
    return bytes;
}
std::uint64_t sentBytes(const std::deque<net::Bot>& bots) {
    std::uint64_t bytes = 0;
    for (const net::Bot& bot : bots) bytes += bot.link().sentBytes();
    return bytes;
}

std::size_t joinedCount(const std::deque<net::Bot>& bots) {
    return static_cast<std::size_t>(std::ranges::count_if(
        bots, [](const net::Bot& bot) { return bot.link().stage() == net::ClientLink::Stage::Joined; }));
}

// Fails if a bot cannot join.
base::Result<void> checkEnded(const std::deque<net::Bot>& bots) {
    for (const net::Bot& bot : bots)
        if (bot.link().stage() == net::ClientLink::Stage::Ended) return base::fail("{}", bot.link().reason());
    return {};
}

// Traffic and time when all bots have joined: later traffic is that of playing.
struct Since {
    net::BotTime at;
    std::uint64_t received = 0, sent = 0;
};

void printReport(const net::BotWorld& world, const std::deque<net::Bot>& bots, const Since& since,
                 net::BotTime now) {
    const double seconds = std::chrono::duration<double>(now - since.at).count();
    const double players = static_cast<double>(std::max<std::size_t>(bots.size(), 1));
    const auto perPlayer = [&](std::uint64_t bytes) {
        return static_cast<double>(bytes) / 1000 / std::max(seconds, 1e-3) / players;
    };
    const nlohmann::json report = {{"bots", bots.size()},
                                   {"joined", joinedCount(bots)},
                                   {"seconds", seconds},
                                   {"edits", world.edits},
                                   {"refused", world.refused},
                                   {"joined_kb_median", base::quantileOf(world.joinedKb, 0.5)},
                                   {"joined_ms_median", base::quantileOf(world.joinedMs, 0.5)},
                                   {"seen", world.seenMs.size()},
                                   {"seen_ms_median", base::quantileOf(world.seenMs, 0.5)},
                                   {"seen_ms_p99", base::quantileOf(world.seenMs, 0.99)},
                                   {"decided_ms_median", base::quantileOf(world.decidedMs, 0.5)},
                                   {"decided_ms_p99", base::quantileOf(world.decidedMs, 0.99)},
                                   {"received_kb_s_player", perPlayer(receivedBytes(bots) - since.received)},
                                   {"sent_kb_s_player", perPlayer(sentBytes(bots) - since.sent)},
                                   {"corrections", world.corrections},
                                   {"cuts", world.cuts},
                                   {"memory_mb", base::megabytes(base::residentBytes())}};
    std::cout << report.dump(1) << '\n';
}

// Writes X Y Z NAME of each acknowledged block; NAME is ? if a later edit has no answer.
base::Result<void> writeAcknowledged(const std::string& file, net::BotWorld& world,
                                     const std::deque<net::Bot>& bots) {
    if (file.empty()) return {};
    for (const net::Bot& bot : bots)
        for (const world::BlockPos pos : bot.undecided()) {
            world.acknowledged.erase(pos);
            world.unknown.insert(pos);
        }
    std::string text;
    for (const world::BlockPos pos : world.unknown) text += fmt::format("{} {} {} ?\n", pos.x, pos.y, pos.z);
    for (const auto& [pos, id] : world.acknowledged)
        text += fmt::format("{} {} {} {}\n", pos.x, pos.y, pos.z, world.land.blocks().type(id).name);
    return base::writeFile(file, text);
}

base::Result<void> addBot(std::deque<net::Bot>& bots, boost::asio::io_context& context, net::BotWorld& world,
                          const net::BotSettings& settings) {
    const int number = static_cast<int>(bots.size());
    const auto key = TERRANE_TRY(net::botKey(settings, number));
    bots.emplace_back(context, world, settings, number, key);
    return {};
}

base::Result<void> runBots(BotsOptions& options) {
    for (const std::string& server : options.servers) {
        auto address = TERRANE_TRY(net::serverAddress(server));
        options.bots.servers.push_back(address);
    }
    options.bots.program = fmt::format("terrane bots {}", TERRANE_VERSION);
    base::raiseOpenFileLimit();
    net::BotWorld world(
        net::ClientPacks{.cache = {}, .acceptsAll = true, .accepted = {}, .packs = {}, .missing = {}});
    boost::asio::io_context context;
    std::deque<net::Bot> bots;
    const base::StopSignals signals;
    const net::BotTime start = std::chrono::steady_clock::now();
    std::optional<Since> since;
    while (!signals.stopRequested()) {
        const net::BotTime now = std::chrono::steady_clock::now();
        const std::chrono::duration<double> passed = now - start;
        const int due =
            std::min(options.count, 1 + static_cast<int>(passed.count() * options.joinsPerSecond));
        while (static_cast<int>(bots.size()) < due) TERRANE_TRY(addBot(bots, context, world, options.bots));
        for (net::Bot& bot : bots) bot.update(now);
        TERRANE_TRY(checkEnded(bots));
        if (!since && joinedCount(bots) == static_cast<std::size_t>(options.count)) {
            since = Since{now, receivedBytes(bots), sentBytes(bots)};
            world.seenMs.clear();
            world.decidedMs.clear();
            base::logInfo("{} bots play", bots.size());
        }
        if (since && now - since->at >= std::chrono::duration<double>(options.seconds)) break;
        context.restart();
        context.run_for(std::chrono::milliseconds(5));
    }
    const net::BotTime end = std::chrono::steady_clock::now();
    printReport(world, bots, since.value_or(Since{end, 0, 0}), end);
    TERRANE_TRY(writeAcknowledged(options.acknowledged, world, bots));
    for (net::Bot& bot : bots) bot.leave();
    context.restart();
    context.run_for(std::chrono::milliseconds(200));
    return {};
}

}  // namespace

CommandEntry addBots(CLI::App& app) {
    auto options = std::make_shared<BotsOptions>();
    CLI::App* command = app.add_subcommand("bots", "Run simulated players that walk and build on a server");
    command
        ->add_option("--connect", options->servers,
                     "The server; repeated, bots are spread over servers of one world")
        ->type_name("HOST[:PORT]")
        ->required();
    command->add_option("--count", options->count, "Number of bots")
        ->check(numberFrom(1, 10000))
        ->capture_default_str();
    command->add_option("--seconds", options->seconds, "Seconds, counted from when all have joined")
        ->check(numberFrom(0, 1e6))
        ->capture_default_str();
    addChoice<net::BotBehaviour>(
        *command, "--behaviour", options->bots.behaviour,
        {{"walk", net::BotBehaviour::Walk},
         {"build", net::BotBehaviour::Build},
         {"crowd", net::BotBehaviour::Crowd}},
        "What they do: walk around where they began, the same while all build, or all "
        "around one place");
    command->add_option("--builders", options->bots.builders, "Share of bots that build while they walk")
        ->check(numberFrom(0, 1))
        ->capture_default_str();
    command
        ->add_option("--edits-per-second", options->bots.editsPerSecond,
                     "Edits per second of each bot that builds")
        ->check(numberFrom(0.01, 50))
        ->capture_default_str();
    command->add_option("--view-distance", options->bots.viewDistance, "View distance of each bot in chunks")
        ->check(numberFrom(1, 64))
        ->capture_default_str();
    command->add_option("--joins-per-second", options->joinsPerSecond, "Bots that join per second")
        ->check(numberFrom(0.1, 1000))
        ->capture_default_str();
    command->add_option("--name", options->bots.name, "Prefix of the names; a number follows")
        ->type_name("TEXT")
        ->capture_default_str();
    command->add_option("--password", options->bots.password, "Password of the server, if it has one")
        ->type_name("TEXT");
    writesFolder(
        command->add_option("--keys", options->bots.keyFolder,
                            "Folder for the bots' keys, so that a server recognizes them in the next run"));
    writesFile(command->add_option(
        "--acknowledged", options->acknowledged,
        "At the end write the blocks that the server acknowledged: one line X Y Z NAME each; "
        "NAME is ? if a newer edit is not decided"));
    return {command, [options] { return runBots(*options); }};
}

}  // namespace terrane::app
