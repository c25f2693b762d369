#include "terrane/store/world_identity.h"

namespace terrane::store {

using base::ErrorCode;

base::Result<void> requireSame(const WorldIdentity& saved, const WorldIdentity& requested,
                               const std::string& where) {
    if (saved.generator != requested.generator)
        return base::fail(ErrorCode::Incompatible, "{}: made by the generator {}, not {}", where,
                          saved.generator, requested.generator);
    if (saved.seed != requested.seed)
        return base::fail(ErrorCode::Incompatible, "{}: made with seed {}, not {}", where, saved.seed,
                          requested.seed);
    if (saved.generatorVersion != requested.generatorVersion)
        return base::fail(
            ErrorCode::Incompatible,
            "{}: made by version {} of the generator {}, this program has version {} "
            "(--regenerate keep-edits regenerates all chunks without edits, --recreate all chunks)",
            where, saved.generatorVersion, saved.generator, requested.generatorVersion);
    return {};
}

base::Result<Regeneration> compareWorld(const WorldIdentity& saved, const RequestedWorld& requested,
                                        const GeneratorVersionOf& versionOf, const std::string& where) {
    const std::string generator = requested.generator.value_or(saved.generator);
    const int version = versionOf(generator);
    if (version == 0) {
        return base::fail(ErrorCode::Incompatible,
                          "{}: made by the generator {}, which this program does not have", where, generator);
    }
    const bool takesAnyVersion = requested.regenerate != Regenerate::None || requested.followsGenerator;
    const WorldIdentity expected{requested.seed.value_or(saved.seed), generator,
                                 takesAnyVersion ? saved.generatorVersion : version};
    TERRANE_TRY(requireSame(saved, expected, where));
    if (requested.regenerate != Regenerate::None || saved.generatorVersion == version)
        return Regeneration{requested.regenerate, version};
    return Regeneration{Regenerate::AllButEdited, version, false};
}

}  // namespace terrane::store
