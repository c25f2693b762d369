// The map that a game server shows to browsers. Runs on the server's thread; tiles are painted on threads of
// their own.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "apps/terrane/maps/map_options.h"
#include "terrane/net/server/server_state.h"
#include "terrane/web/page.h"
#include "terrane/world/blocks/block_model.h"

namespace terrane::app {

// The players on a server's map. Runs on the server's thread.
// Omits players under ground, if asked to: those with three opaque blocks above their head.
class PlayerList {
  public:
    // The clients and the session of the server outlive it.
    PlayerList(const net::ServerClients& clients, game::Session& session, ShownPlayers shown)
        : clients_(clients), session_(session), shown_(shown) {}

    // Requests the chunks that players are in. Until a chunk is loaded, a player from a neighboring chunk
    // keeps its state, and others are omitted.
    std::vector<web::MapMarker> now();

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

}  // namespace terrane::app

namespace boost::asio {
class io_context;
}

namespace terrane::app {

class ServerMap {
  public:
    // Null if the options name no port. `world`: as on the command line; `files`: from serverFilesOf(). The
    // context and the server outlive the map.
    [[nodiscard]] static base::Result<std::unique_ptr<ServerMap>> open(boost::asio::io_context& context,
                                                                       net::ServerState& server,
                                                                       const std::string& world,
                                                                       const MapSiteOptions& options,
                                                                       const std::filesystem::path& files,
                                                                       const world::TextureSource& textures);
    ~ServerMap();

    // Call after each tick of the server with its duration.
    void tick(double milliseconds);

  private:
    struct Impl;
    explicit ServerMap(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace terrane::app
