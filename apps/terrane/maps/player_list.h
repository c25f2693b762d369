// The players whom a server's map shows. On the server's thread.
#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "apps/terrane/maps/map_options.h"
#include "terrane/net/server_state.h"
#include "terrane/web/page.h"

namespace terrane::app {

// Leaves out who is under ground, if asked to: who has three blocks above its head through which nobody sees.
class PlayerList {
  public:
    // The server outlives it.
    PlayerList(net::ServerState& server, ShownPlayers shown) : server_(server), shown_(shown) {}

    // Asks for the chunks that players are in. Until one is loaded, who came from beside it is as it was
    // before, and others are left out.
    std::vector<web::NamedPlace> now();

  private:
    // Nothing where the chunk is not loaded.
    std::optional<bool> isUnderGround(const world::Pose& pose) const;

    net::ServerState& server_;
    ShownPlayers shown_;
    struct Known {
        world::ChunkPos chunk;  // where it was seen last
        bool isHidden = false;
    };
    std::unordered_map<game::PlayerId, Known> known_;
};

}  // namespace terrane::app
