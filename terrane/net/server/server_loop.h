// The main loop of a server: ticks, console, clean shutdown. On the server's thread.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "terrane/gen/generators/catalogue.h"
#include "terrane/net/server/server.h"
#include "terrane/net/server/server_sockets.h"

namespace terrane::net {

// A world opened for a server: session, records, players, and server state.
// Members refer to earlier ones: destroyed in reverse order.
struct ServerHost {
    std::unique_ptr<game::Session> session;
    std::unique_ptr<ServerRecords> records;
    std::unique_ptr<KnownPlayers> knownPlayers;
    std::unique_ptr<ServerState> state;
};

// The generators available to the world, and its content packs.
struct ServerContent {
    gen::GeneratorCatalogue generators = gen::builtInGenerators();
    std::vector<OfferedPack> packs = {};
};

// Opens a server that is ready for players. `parts`, `records`: of the same world; `program`: its name and
// version. Takes up to a second, and longer after a crash to restore edits.
[[nodiscard]] base::Result<ServerHost> openServerHost(game::SessionParts parts,
                                                      std::unique_ptr<ServerRecords> records,
                                                      const ServerSettings& settings,
                                                      const std::string& program,
                                                      const ServerContent& content = {});

struct ServerLoop {
    std::function<bool()> stopRequested = {};              // called in each tick; may be empty
    std::function<void(double milliseconds)> onTick = {};  // duration of each tick; may be empty
};

// Runs the server until the console, a signal or `stopRequested` stops it; then disconnects all players and
// saves everything.
[[nodiscard]] base::Result<void> runServer(boost::asio::io_context& context, ServerState& server,
                                           ServerSockets& sockets, const ServerLoop& loop);

}  // namespace terrane::net
