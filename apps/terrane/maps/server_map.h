// The map that a game server shows to browsers. Runs on the server's thread; tiles are painted on threads of
// their own.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "apps/terrane/maps/map_options.h"
#include "terrane/net/server_state.h"
#include "terrane/world/texture_source.h"

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
