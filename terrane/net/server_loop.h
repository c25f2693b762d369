// The main loop of a server: ticks, console, clean shutdown. On the server's thread.
#pragma once

#include <functional>

#include "terrane/net/server_sockets.h"

namespace terrane::net {

struct ServerLoop {
    std::function<bool()> stopAsked = {};                  // called in each tick; may be empty
    std::function<void(double milliseconds)> onTick = {};  // duration of each tick; may be empty
};

// Runs the server until the console, a signal or `stopAsked` stops it; then disconnects all players and saves
// everything.
[[nodiscard]] base::Result<void> runServer(boost::asio::io_context& context, ServerState& server,
                                           ServerSockets& sockets, const ServerLoop& loop);

}  // namespace terrane::net
