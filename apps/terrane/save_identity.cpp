#include "apps/terrane/save_identity.h"

#include "terrane/gen/generators/catalogue.h"

namespace terrane::app {

store::WorldIdentity identityOf(const WorldOptions& options) {
    return {options.seed, options.generator, gen::generatorVersion(options.generator)};
}

base::Result<void> adoptIdentity(WorldOptions& options, const CLI::App& command,
                                 const store::WorldIdentity& saved, const std::string& path) {
    if (command.get_option("--seed")->count() == 0) options.seed = saved.seed;
    if (command.get_option("--generator")->count() == 0) options.generator = saved.generator;
    return store::requireSame(saved, identityOf(options), path);
}

}  // namespace terrane::app
