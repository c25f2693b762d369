// Options of `terrane serve`, on the command line and as keys of a settings file (TOML).
#pragma once

#include <string>

#include "apps/terrane/map_options.h"
#include "apps/terrane/options.h"
#include "terrane/net/server/server_sockets.h"
#include "terrane/net/server/server_state.h"

namespace terrane::app {

struct ServeOptions {
    io::WorldOptions world;
    io::SaveOptions save;
    std::string settingsFile;  // empty: NAME.server.toml beside the world, if it exists
    net::ListenAddress listen;
    std::string publicAddress;  // empty: from the machine's name and the port
    net::ServerSettings server;
    bool isReadOnly = false;
    std::string mode;  // of the world, by game::kModeNames; empty: its own
    MapSiteOptions map;
    std::string statistics;  // file; empty: none
};

void addServeOptions(CLI::App& command, ServeOptions& options);

}  // namespace terrane::app
