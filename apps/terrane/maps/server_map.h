// The map that a server shows to browsers while people play: on the server's thread, its tiles on threads of
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
    // Null where the options name no port. `world`: as the command line names it; `files`: as serverFilesOf()
    // names them. The context and the server outlive it.
    [[nodiscard]] static base::Result<std::unique_ptr<ServerMap>> open(boost::asio::io_context& context,
                                                                       net::ServerState& server,
                                                                       const std::string& world,
                                                                       const MapSiteOptions& options,
                                                                       const std::filesystem::path& files,
                                                                       const world::TextureSource& textures);
    ~ServerMap();

    // After each tick of the server, which took so long.
    void tick(double milliseconds);

  private:
    struct Impl;
    explicit ServerMap(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace terrane::app
