#include "apps/terrane/formats/import_world.h"

#include "apps/terrane/open_session.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/stream/tile_rows.h"

namespace terrane::app {

base::Result<ImportWorld> openImportWorld(ImportOptions& options, pack::Content content) {
    if (options.save.world.empty())
        return base::fail(base::ErrorCode::BadInput, "import needs --world NAME|FILE|URL");
    ImportWorld world;
    world.content = std::move(content);
    auto store =
        TERRANE_TRY(openSave(options.world, options.save, store::WorldAccess::ReadWrite, world.content));
    auto generators =
        TERRANE_TRY(gen::makeLevelGenerators(options.world.effectiveGenerator(), *world.content.blocks,
                                             options.world.effectiveSeed(), world.content.generators));
    world.generators = std::make_unique<gen::LevelGenerators>(std::move(generators));
    world.store = std::move(store);
    stream::keepTileRows(*world.store, *world.generators, *world.content.blocks, {});
    return world;
}

}  // namespace terrane::app
