// terrane serve: hosts a world for several players over a network.
#include <boost/asio/io_context.hpp>
#include <filesystem>
#include <memory>
#include <optional>

#include "apps/terrane/commands/commands.h"
#include "apps/terrane/map_options.h"
#include "apps/terrane/options.h"
#include "apps/terrane/output_files.h"
#include "apps/terrane/serve_options.h"
#include "apps/terrane/settings.h"
#include "apps/terrane/world_backup.h"
#include "terrane/base/log.h"
#include "terrane/base/machine.h"
#include "terrane/game/item_commands.h"
#include "terrane/io/open_session.h"
#include "terrane/net/client/client_packs.h"
#include "terrane/net/server/server_console.h"
#include "terrane/net/server/server_loop.h"
#include "terrane/net/server/server_statistics.h"
#include "terrane/net_postgres/world_records.h"
#include "terrane/rules/rules.h"
#include "terrane/store_postgres/any_world.h"

namespace terrane::app {
namespace {

std::filesystem::path withEnding(const std::filesystem::path& files, const std::string& ending) {
    return files.string() + ending;
}

base::Result<void> readSettings(ServeOptions& options, const std::filesystem::path& files,
                                CLI::App& command) {
    std::error_code ignored;
    const bool isNamed = !options.settingsFile.empty();
    const std::filesystem::path file =
        isNamed ? std::filesystem::path(options.settingsFile) : withEnding(files, ".server.toml");
    // A link to nothing is none that was meant to be without settings.
    const bool isExpected = isNamed || std::filesystem::is_symlink(file, ignored);
    if (isExpected && !std::filesystem::exists(file, ignored))
        return base::fail(base::ErrorCode::NotFound, "{}: there is no such file", file.string());
    return applySettings(file, command, {});
}

// The address by which players of other servers reach this one.
std::string publicAddress(const ServeOptions& options, std::uint16_t port) {
    if (!options.publicAddress.empty()) return options.publicAddress;
    const std::string& address = options.listen.address;
    const bool isAll = address == "::" || address == "0.0.0.0";
    const std::string name = isAll ? base::machineName() : address;
    return name.find(':') == std::string::npos ? fmt::format("{}:{}", name, port)
                                               : fmt::format("[{}]:{}", name, port);
}

// The packs without seed and generator, which a world has itself.
io::WorldOptions packsOfWorld(const io::WorldOptions& options) {
    io::WorldOptions content;
    content.content = options.content;
    content.threads = options.threads;
    return content;
}

base::Result<void> serve(ServeOptions& options, CLI::App& command) {
    const store::WorldLocation world = store::worldLocation(options.save.world);
    const auto files = TERRANE_TRY(net_postgres::serverFilesOf(world, options.listen.port));
    TERRANE_TRY(readSettings(options, files, command));
    TERRANE_TRY(checkOutputs(command));
    options.server.mode = game::modeNamed(options.mode);
    if (options.isReadOnly) options.server.newcomers = game::Role::Guest;
    TERRANE_TRY(checkMapSite(options.map));
    auto statistics = TERRANE_TRY(net::ServerStatistics::open(options.statistics));
    auto opened = TERRANE_TRY(io::openSessionParts(options.world, options.save, store::WorldAccess::ReadWrite,
                                                   store::WorldSharing::Servers));
    game::SessionParts& parts = opened.parts;
    const auto content = TERRANE_TRY(net::serverContent(opened.content));
    // Clients generate unedited chunks themselves: the server needs them rarely, and regenerates them.
    parts.storesGenerated = false;
    auto records = TERRANE_TRY(net_postgres::openRecords(world, *parts.blocks));
    auto host = TERRANE_TRY(net::openServerHost(std::move(parts), std::move(records.records), options.server,
                                                fmt::format("terrane {}", TERRANE_VERSION), content));
    const rules::Rules rules(*host.session, *opened.content.packs);
    // Items in a world of several servers are not kept with its blocks.
    std::optional<game::ItemCommands> itemCommands;
    if (!host.state->sharing.shared)
        itemCommands.emplace(*host.session,
                             [&permissions = host.session->permissions](game::PlayerId player) {
                                 return permissions.roleOf(player) == game::Role::Operator;
                             });
    host.state->backup.files = files;
    host.state->backup.ofDatabase = [world, content = packsOfWorld(options.world)](
                                        const std::filesystem::path& save,
                                        const store::CopyProgress& progress) {
        return writeBackup(world, content, save, progress);
    };
    base::raiseOpenFileLimit();
    boost::asio::io_context context;
    auto sockets = TERRANE_TRY(
        net::ServerSockets::open(context, *host.state, options.listen, withEnding(files, ".server.pem")));
    if (records.publishAddress)
        records.publishAddress(publicAddress(options, sockets->port()), sockets->key());
    base::logInfo("{} on port {}, seed {}, generator {}; key {}", store_postgres::shownOf(world),
                  sockets->port(), host.state->offer.fingerprint.identity.seed,
                  host.state->offer.fingerprint.identity.generator, sockets->key());
    const auto map = TERRANE_TRY(
        openServerMap(context, *host.state, options.save.world, options.map, files, opened.content.textures));
    net::ServerLoop loop;
    loop.onTick = [&](double milliseconds) {
        statistics.addTick(net::countsOf(*host.state), milliseconds);
        if (map) map(milliseconds);
    };
    return net::runServer(context, *host.state, *sockets, loop);
}

}  // namespace

CommandEntry addServe(CLI::App& app) {
    auto options = std::make_shared<ServeOptions>();
    CLI::App* command = app.add_subcommand("serve", "Run a server: several players in one world");
    addServeOptions(*command, *options);
    command->footer(
        "Commands on standard input, for operators in the chat behind a slash:\n" + net::consoleHelp() +
        "\n\nSIGTERM saves and ends, as `stop` does. The server's file NAME.server.sqlite (players, "
        "claims, history) and\nits key NAME.server.pem are beside the world. Several servers may serve one "
        "world in a database.");
    return {command, [options, command] { return serve(*options, *command); }};
}

}  // namespace terrane::app
