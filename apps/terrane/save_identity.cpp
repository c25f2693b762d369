#include "apps/terrane/save_identity.h"

#include <CLI/CLI.hpp>
#include "terrane/gen/generators/catalogue.h"

namespace terrane::app {

store::WorldIdentity identityOf(const WorldOptions& options) {
    return {options.seed, options.generator, gen::generatorVersion(options.generator)};
}

store::SaveAccess accessTo(const SaveRequest& request, WorldOptions& options, const CLI::App& command) {
    store::SaveAccess access;
    access.create = identityOf(options);
    access.decide = [&options, &command,
                     request](const store::WorldIdentity& saved) -> base::Result<std::optional<int>> {
        if (command.get_option("--seed")->count() == 0) options.seed = saved.seed;
        if (command.get_option("--generator")->count() == 0) options.generator = saved.generator;
        store::WorldIdentity wanted = identityOf(options);
        const int version = wanted.generatorVersion;
        if (version == 0) {
            return base::fail("{}: made by the generator {}, which this program does not have",
                              request.path.string(), wanted.generator);
        }
        if (request.recreate) wanted.generatorVersion = saved.generatorVersion;
        auto same = store::requireSame(saved, wanted, request.path.string());
        if (!same) return tl::unexpected(same.error());
        return request.recreate ? std::optional(version) : std::nullopt;
    };
    return access;
}

}  // namespace terrane::app
