#include "terrane/store/chunk_store.h"

namespace terrane::store {

base::Result<void> requireSame(const WorldIdentity& saved, const WorldIdentity& wanted,
                               const std::string& path) {
    if (saved.generator != wanted.generator)
        return base::fail("{}: made by the generator {}, not {}", path, saved.generator, wanted.generator);
    if (saved.seed != wanted.seed)
        return base::fail("{}: made with seed {}, not {}", path, saved.seed, wanted.seed);
    if (saved.generatorVersion != wanted.generatorVersion)
        return base::fail(
            "{}: made by version {} of the generator {}, this program has version {} (--recreate makes it "
            "anew)",
            path, saved.generatorVersion, saved.generator, wanted.generatorVersion);
    return {};
}

}  // namespace terrane::store
