// The map that a game server shows to browsers. Runs on the server's thread; tiles are painted on threads of
// their own.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "terrane/net/server/server_state.h"
#include "terrane/web/map_parts.h"
#include "terrane/web/page.h"
#include "terrane/world/blocks/block_model.h"

namespace terrane::web {

enum class ShownPlayers : std::uint8_t { None, Surface, All };

// The players on a server's map. Runs on the server's thread.
// Omits players under ground, if asked to: those with three opaque blocks above their head.
class ServerPlayers {
  public:
    // The clients and the session of the server outlive it.
    ServerPlayers(const net::ServerClients& clients, game::Session& session, ShownPlayers shown)
        : clients_(clients), session_(session), shown_(shown) {}

    // Requests the chunks that players are in. Until a chunk is loaded, a player from a neighboring chunk
    // keeps its state, and others are omitted.
    std::vector<MapMarker> now();

  private:
    // None if the chunk is not loaded.
    std::optional<bool> isUnderGround(const world::Pose& pose) const;

    const net::ServerClients& clients_;
    game::Session& session_;
    ShownPlayers shown_;
    struct Known {
        world::ChunkPos chunk;  // in which isHidden was determined
        bool isHidden = false;
    };
    std::unordered_map<game::PlayerId, Known> known_;
};

}  // namespace terrane::web

namespace boost::asio {
class io_context;
}

namespace terrane::web {

class ServerMap {
  public:
    // The context and the server outlive the map.
    [[nodiscard]] static base::Result<std::unique_ptr<ServerMap>> open(boost::asio::io_context& context,
                                                                       net::ServerState& server,
                                                                       const MapSettings& settings,
                                                                       ShownPlayers players,
                                                                       const world::TextureSource& textures);
    ~ServerMap();

    std::uint16_t port() const;
    // Call after each tick of the server with its duration.
    void tick(double milliseconds);

  private:
    struct Impl;
    explicit ServerMap(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace terrane::web
