// A build without browser maps: commands lack their options.
#include "apps/terrane/maps/http_map.h"
#include "apps/terrane/maps/map_options.h"
#include "apps/terrane/maps/server_map.h"
#include "apps/terrane/maps/static_map.h"

namespace terrane::app {

void addMapSiteOptions(CLI::App&, MapSiteOptions&, bool) {}
base::Result<void> checkMapSite(const MapSiteOptions&) {
    return {};
}
void addStaticMapOptions(CLI::App&, StaticMapOptions&) {}

base::Result<void> showMap(io::WorldOptions&, const io::SaveOptions&, const std::string&,
                           const MapSiteOptions&) {
    return base::fail(base::ErrorCode::Unsupported, "this build has no maps for browsers");
}
base::Result<void> writeStaticMap(io::WorldOptions&, const io::SaveOptions&, const std::string&,
                                  const world::ChunkArea&, const StaticMapOptions&) {
    return base::fail(base::ErrorCode::Unsupported, "this build has no maps for browsers");
}

struct ServerMap::Impl {};

base::Result<std::unique_ptr<ServerMap>> ServerMap::open(boost::asio::io_context&, net::ServerState&,
                                                         const std::string&, const MapSiteOptions&,
                                                         const std::filesystem::path&,
                                                         const world::TextureSource&) {
    return nullptr;
}

ServerMap::ServerMap(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ServerMap::~ServerMap() = default;
void ServerMap::tick(double) {}

}  // namespace terrane::app
