// A world opened for a server: its session, the server's records, the people, and the server's state.
#pragma once

#include <memory>
#include <string>

#include "terrane/gen/generators/catalogue.h"
#include "terrane/net/server.h"

namespace terrane::net {

// They refer to each other: destroyed in reverse order.
struct ServerHost {
    std::unique_ptr<game::Session> session;
    std::unique_ptr<ServerRecords> records;
    std::unique_ptr<People> people;
    std::unique_ptr<ServerState> state;
};

// The generators that the world may have, and its packs.
struct ServerContent {
    gen::GeneratorCatalogue generators = gen::builtInGenerators();
    std::vector<OfferedPack> packs = {};
};

// Ready for players. `parts`: of the world; `records`: of the same world; `program`: its name and version.
// Takes up to a second, and what it takes to bring back edits after a crash.
[[nodiscard]] base::Result<ServerHost> openServerHost(game::SessionParts parts,
                                                      std::unique_ptr<ServerRecords> records,
                                                      const ServerSettings& settings,
                                                      const std::string& program,
                                                      const ServerContent& content = {});

}  // namespace terrane::net
