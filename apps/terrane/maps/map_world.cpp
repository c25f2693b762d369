#include "apps/terrane/maps/map_world.h"

#include <sstream>
#include <string>
#include <utility>

#include "apps/terrane/open_session.h"
#include "terrane/base/files.h"
#include "terrane/content/resource_pack.h"
#include "terrane/stream/edited_tiles.h"

namespace terrane::app {

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

base::Result<std::unique_ptr<MapWorld>> openMapWorld(WorldOptions& options, const SaveOptions& save,
                                                     const std::string& resourcePack) {
    auto opened = TERRANE_TRY(openSessionParts(options, save, store::WorldAccess::ReadOnly));
    auto world = std::make_unique<MapWorld>(MapWorld{std::move(opened.parts), {}, {}});
    store::ChunkStore& store = *world->parts.store;
    stream::maintainTileRows(store, world->parts.generators, *world->parts.blocks, {});
    TERRANE_TRY(stream::buildTileRows(store));
    auto edited = TERRANE_TRY(store.editedChunks());
    world->edited = std::move(edited);
    auto textures = content::loadTextures(resourcePack, *world->parts.blocks, opened.content.textures);
    if (!textures) return tl::unexpected(textures.error());
    world->textures = std::move(*textures);
    return world;
}

base::Result<map::MapPainter> painterOf(MapWorld& world, map::SurfaceCache* cache) {
    const store::WorldIdentity& identity = world.parts.store->identity();
    return map::MapPainter::create(
        {world.parts.generators, *world.parts.blocks, world.textures, world.parts.store.get(), cache,
         gen::Biomes::create(identity.generator, *world.parts.blocks, identity.seed)});
}

}  // namespace terrane::app
