#include "terrane/web/map_parts.h"

#include <boost/asio/ip/address.hpp>
#include <charconv>
#include <sstream>

#include "terrane/base/digest.h"
#include "terrane/base/files.h"
#include "terrane/base/log.h"
#include "terrane/game/spawn.h"
#include "terrane/store/saves/save_path.h"

namespace terrane::web {
namespace {

base::Result<WebAddress> notAnAddress(const std::string& text) {
    return base::fail(base::ErrorCode::BadInput, "{} is no port or ADDRESS:PORT, such as 8080 or [::]:8080",
                      text);
}

}  // namespace

base::Result<WebAddress> webAddressFrom(const std::string& text) {
    WebAddress address;
    const std::size_t colon = text.rfind(':');
    std::string_view port = text;
    if (colon != std::string::npos) {
        address.address = text.substr(0, colon);
        port.remove_prefix(colon + 1);
        const bool isBracketed = address.address.starts_with('[') && address.address.ends_with(']');
        if (isBracketed) address.address = address.address.substr(1, address.address.size() - 2);
        const bool hasColon = address.address.find(':') != std::string::npos;
        if (address.address.empty() || hasColon != isBracketed) return notAnAddress(text);
    }
    const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), address.port);
    if (error != std::errc() || end != port.data() + port.size()) return notAnAddress(text);
    boost::system::error_code wrong;
    boost::asio::ip::make_address(address.address, wrong);
    if (wrong)
        return base::fail(base::ErrorCode::BadInput,
                          "{} is no address to listen on, such as 127.0.0.1 or ::", address.address);
    return address;
}

std::string urlOf(const WebAddress& address, std::uint16_t port) {
    const bool isAll = address.address == "0.0.0.0" || address.address == "::";
    if (isAll) return fmt::format("http://localhost:{}/", port);
    const bool isV6 = address.address.find(':') != std::string::npos;
    return isV6 ? fmt::format("http://[{}]:{}/", address.address, port)
                : fmt::format("http://{}:{}/", address.address, port);
}

std::string originOf(const store::WorldIdentity& identity, const world::BlockRegistry& blocks) {
    const map::SurfaceKinds kinds = map::surfaceKinds(blocks);
    std::string names;
    for (std::size_t id = 0; id < kinds.size(); ++id)
        names += fmt::format("{} {}\n", blocks.types()[id].name, static_cast<int>(kinds[id]));
    return fmt::format("{} {} {} {:016x}", identity.seed, identity.generator, identity.generatorVersion,
                       base::hash64(names));
}

std::filesystem::path mapCacheFile(const std::string& world, const std::string& origin) {
    std::error_code error;
    const store::WorldLocation location = store::worldLocation(world);
    if (!world.empty() && location.kind != store::WorldLocation::Kind::Url)
        if (auto file = store::fileOf(location)) return file->replace_extension(kMapCacheEnding);
    const auto folder = store::dataFolder(store::saveEnvironment());
    if (!folder) return {};
    std::filesystem::create_directories(*folder, error);
    return *folder / fmt::format("generated-{:016x}{}", base::hash64(origin), kMapCacheEnding);
}

std::unique_ptr<map::SurfaceCache> openMapCache(const MapSettings& settings, const std::string& origin) {
    if (settings.cache.empty() || settings.diskMegabytes == 0) return nullptr;
    auto cache =
        map::SurfaceCache::open(settings.cache, origin, std::int64_t{settings.diskMegabytes} * 1'000'000);
    if (cache) return std::move(*cache);
    base::logWarning("{}; the map keeps nothing on disk", cache.error().message);
    return nullptr;
}

std::string titleOf(const std::string& world) {
    if (world.empty()) return "Terrane";
    if (store::worldLocation(world).kind != store::WorldLocation::Kind::Url)
        return std::filesystem::path(world).stem().string();
    // Omits the part before the path, which may hold a password.
    const std::string_view path = std::string_view(world).substr(0, world.find('?'));
    const std::size_t slash = path.rfind('/');
    const bool hasName = slash + 1 < path.size() && slash > 0 && path[slash - 1] != '/';
    return hasName ? std::string(path.substr(slash + 1)) : "Terrane";
}

namespace {

// The map shows all places at once: 1,000 names of up to game::kMaxPlaceName bytes are 100 KB for a browser.
constexpr std::size_t kMaxPlaces = 1000, kMaxBytes = std::size_t{1} << 20;

}  // namespace

base::Result<std::vector<game::Place>> readPlaceFile(const std::filesystem::path& file) {
    std::vector<game::Place> places;
    if (file.empty()) return places;
    const auto text = TERRANE_TRY(base::readFile(file, kMaxBytes));
    std::istringstream in(text);
    int line = 0, unnamed = 0;
    for (std::string words; std::getline(in, words);) {
        ++line;
        if (words.find_first_not_of(" \t\r") == std::string::npos) continue;
        if (words.back() == '\r') words.pop_back();
        auto place = game::placeFrom(words);
        if (!place)
            return base::fail(base::ErrorCode::BadInput, "{}:{}: no place: expected X Y Z YAW PITCH NAME",
                              file.string(), line);
        if (places.size() == kMaxPlaces)
            return base::fail(base::ErrorCode::BadInput, "{}:{}: more than {} places", file.string(), line,
                              kMaxPlaces);
        if (place->name.empty()) place->name = std::to_string(++unnamed);
        places.push_back(std::move(*place));
    }
    return places;
}

MapMarker namedPlace(const std::string& name, const world::Pose& pose) {
    return {name, pose.position.x, pose.position.y, pose.position.z};
}

std::vector<MapMarker> namedPlaces(const std::vector<game::Place>& places) {
    std::vector<MapMarker> named;
    for (const game::Place& place : places) named.push_back(namedPlace(place.name, place.pose));
    return named;
}

std::vector<MapMarker> allPlaces(store::ReadableStore& store, const std::vector<game::Place>& ofFile) {
    std::vector<game::Place> places = game::savedPlaces(store);
    places.insert(places.end(), ofFile.begin(), ofFile.end());
    return namedPlaces(places);
}

base::Result<MapMarker> spawnOf(const io::MapWorld& world) {
    const auto generator = TERRANE_TRY(world.parts.generators.at(0));
    return namedPlace("", game::findSpawn(*generator, *world.parts.blocks));
}

}  // namespace terrane::web
