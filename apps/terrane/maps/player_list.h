// The players on a server's map. Runs on the server's thread.
#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "apps/terrane/maps/map_options.h"
#include "terrane/net/server_state.h"
#include "terrane/web/page.h"

namespace terrane::app {

// Omits players under ground, if asked to: those with three opaque blocks above their head.
class PlayerList {
  public:
    // The server outlives it.
    PlayerList(net::ServerState& server, ShownPlayers shown) : server_(server), shown_(shown) {}

    // Requests the chunks that players are in. Until a chunk is loaded, a player from a neighboring chunk
    // keeps its state, and others are omitted.
    std::vector<web::NamedPlace> now();

  private:
    // None if the chunk is not loaded.
    std::optional<bool> isUnderGround(const world::Pose& pose) const;

    net::ServerState& server_;
    ShownPlayers shown_;
    struct Known {
        world::ChunkPos chunk;  // in which isHidden was determined
        bool isHidden = false;
    };
    std::unordered_map<game::PlayerId, Known> known_;
};

}  // namespace terrane::app
