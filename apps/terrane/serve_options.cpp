#include "apps/terrane/serve_options.h"

#include "apps/terrane/options.h"
#include "apps/terrane/output_files.h"

namespace terrane::app {

void addServeOptions(CLI::App& command, ServeOptions& options) {
    addWorldOptions(command, options.world);
    addWorldOption(command, options.save, "World to serve; created if needed");
    command.get_option("--world")->required()->configurable(false);
    command
        .add_option("--settings", options.settingsFile,
                    "Settings file (TOML) with the names of these options (default: NAME.server.toml beside "
                    "the world, if it exists)")
        ->type_name("FILE")
        ->configurable(false);
    command
        .add_option("--address", options.listen.address,
                    "Address to listen on; :: is all, 127.0.0.1 this machine")
        ->capture_default_str();
    command.add_option("--port", options.listen.port, "Port to listen on; 0: one that is free")
        ->capture_default_str();
    command
        .add_option("--public-address", options.publicAddress,
                    "Address of this server that other servers of the same world tell players (default: the "
                    "name of the machine and the port)")
        ->type_name("HOST:PORT");
    command.add_option("--max-players", options.server.maxPlayers, "Maximum number of players")
        ->check(numberFrom(1, 4096))
        ->capture_default_str();
    command
        .add_option("--max-players-of-address", options.server.maxPlayersOfAddress,
                    "Maximum number of players at a time from one address, except this machine's")
        ->check(numberFrom(1, 4096))
        ->capture_default_str();
    command
        .add_option("--new-players", options.server.newPlayersPerHour,
                    "Maximum number of first visits per hour from one address, except this machine's")
        ->check(numberFrom(1, 1e6))
        ->capture_default_str();
    command
        .add_option("--max-view-distance", options.server.maxViewDistance,
                    "Distance in chunks up to which a player receives edits")
        ->check(numberFrom(2, 64))
        ->capture_default_str();
    command
        .add_option("--max-speed", options.server.maxSpeed, "Maximum speed of a player in blocks per second")
        ->check(numberFrom(1, 100000))
        ->capture_default_str();
    command
        .add_option("--max-fill", options.server.maxFillBlocks,
                    "Maximum number of blocks that one command fills")
        ->check(numberFrom(1, 131072))
        ->capture_default_str();
    command
        .add_option("--max-places-of-player", options.server.maxPlacesOfPlayer,
                    "Maximum number of places that a player who is no operator may name")
        ->check(numberFrom(0, 200))
        ->capture_default_str();
    command
        .add_option("--spawn-radius", options.server.spawnRadius,
                    "Newcomers appear on free ground around a column at most this many blocks from the spawn")
        ->check(numberFrom(0, 1000000))
        ->capture_default_str();
    addModeOption(command, options.mode);
    command.add_option("--day-minutes", options.server.dayMinutes, "Length of a day in minutes")
        ->check(numberFrom(0.5, 1440))
        ->capture_default_str();
    command.add_option("--welcome", options.server.welcome, "Chat line for each player who joins")
        ->type_name("TEXT");
    command.add_flag("--read-only", options.isReadOnly,
                     "Newcomers are guests: they look and talk, but change nothing");
    writesFile(command.add_option("--statistics", options.statistics,
                                  "Write a line (JSON) each ten seconds: ticks, players, memory"));
    addMapSiteOptions(command, options.map, true);
}

}  // namespace terrane::app
