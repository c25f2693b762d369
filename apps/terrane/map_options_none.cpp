// A build without browser maps: commands lack their options.
#include "apps/terrane/map_options.h"

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

base::Result<MapTick> openServerMap(boost::asio::io_context&, net::ServerState&, const std::string&,
                                    const MapSiteOptions&, const std::filesystem::path&,
                                    const world::TextureSource&) {
    return MapTick();
}

}  // namespace terrane::app
