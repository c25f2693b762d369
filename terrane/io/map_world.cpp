#include "terrane/io/map_world.h"

#include <utility>

#include "terrane/content/resource_pack.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/io/open_session.h"
#include "terrane/stream/edited_tiles.h"

namespace terrane::io {

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
         gen::Biomes::create(identity.generator, *world.parts.blocks, identity.seed),
         gen::seaLevelOf(identity.generator)});
}

}  // namespace terrane::io
