#include "apps/terrane/open_save.h"

#include "terrane/gen/generators/catalogue.h"

namespace terrane::app {

store::WorldIdentity identityOf(const WorldOptions& options) {
    const std::string generator = options.effectiveGenerator();
    return {options.effectiveSeed(), generator, gen::generatorVersion(generator)};
}

base::Result<std::unique_ptr<store::ChunkStore>> openSave(WorldOptions& options, const SaveOptions& save,
                                                          store::WorldAccess access,
                                                          const world::BlockRegistry& blocks) {
    if (save.world.empty()) {
        if (save.recreate) return base::fail(base::ErrorCode::BadInput, "--recreate requires --world");
        return nullptr;
    }
    // Before a save is made: a generator that does not exist has none.
    if (auto known = gen::makeGenerator(options.effectiveGenerator(), blocks); !known)
        return tl::unexpected(known.error());
    store::WorldRequest request;
    request.access = access;
    if (access != store::WorldAccess::ReadOnly) request.create = identityOf(options);
    request.wanted = {options.seed, options.generator, save.recreate};
    request.versionOf = gen::generatorVersion;
    auto opened = store::openWorld(store::worldLocation(save.world), blocks, request);
    if (!opened) return opened;
    options.seed = (*opened)->identity().seed;
    options.generator = (*opened)->identity().generator;
    return opened;
}

}  // namespace terrane::app
