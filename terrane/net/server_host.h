// A world opened for a server: its session, the server's file beside it, the people, and the server's state.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "terrane/net/server.h"

namespace terrane::net {

// They refer to each other: destroyed in reverse order.
struct ServerHost {
    std::unique_ptr<game::Session> session;
    std::unique_ptr<ServerFile> file;
    std::unique_ptr<People> people;
    std::unique_ptr<ServerState> state;
};

// Ready for players. `parts`: of the world; `serverFile`: made where it is not there; `program`: its name and
// version. Takes up to a second, and what it takes to bring back edits after a crash.
[[nodiscard]] base::Result<ServerHost> openServerHost(game::SessionParts parts,
                                                      const std::filesystem::path& serverFile,
                                                      const ServerSettings& settings,
                                                      const std::string& program);

}  // namespace terrane::net
