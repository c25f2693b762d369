// The loop of a server: ticks, its console, and a clean end. On the server's thread.
#pragma once

#include <functional>

#include "terrane/net/server_sockets.h"

namespace terrane::net {

struct ServerLoop {
    bool readsConsole = true;                              // lines of standard input
    std::function<bool()> stopAsked = {};                  // asked in each tick; may be empty
    std::function<void(double milliseconds)> onTick = {};  // how long each took; may be empty
};

// Runs the server until the console, a signal or `stopAsked` ends it; then everybody is sent away, and all is
// saved.
[[nodiscard]] base::Result<void> runServer(boost::asio::io_context& context, ServerState& server,
                                           ServerSockets& sockets, const ServerLoop& loop);

}  // namespace terrane::net
