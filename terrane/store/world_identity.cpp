#include "terrane/store/world_identity.h"

namespace terrane::store {

using base::ErrorCode;

base::Result<void> requireSame(const WorldIdentity& saved, const WorldIdentity& wanted,
                               const std::string& where) {
    if (saved.generator != wanted.generator)
        return base::fail(ErrorCode::Incompatible, "{}: made by the generator {}, not {}", where,
                          saved.generator, wanted.generator);
    if (saved.seed != wanted.seed)
        return base::fail(ErrorCode::Incompatible, "{}: made with seed {}, not {}", where, saved.seed,
                          wanted.seed);
    if (saved.generatorVersion != wanted.generatorVersion)
        return base::fail(ErrorCode::Incompatible,
                          "{}: made by version {} of the generator {}, this program has version {} "
                          "(--regenerate keep-edits makes all chunks without edits anew, --recreate all)",
                          where, saved.generatorVersion, saved.generator, wanted.generatorVersion);
    return {};
}

base::Result<Regeneration> compareWorld(const WorldIdentity& saved, const WantedWorld& wanted,
                                        const GeneratorVersionOf& versionOf, const std::string& where) {
    const std::string generator = wanted.generator.value_or(saved.generator);
    const int version = versionOf(generator);
    if (version == 0) {
        return base::fail(ErrorCode::Incompatible,
                          "{}: made by the generator {}, which this program does not have", where, generator);
    }
    const bool takesAnyVersion = wanted.regenerate != Regenerate::None || wanted.followsGenerator;
    const WorldIdentity expected{wanted.seed.value_or(saved.seed), generator,
                                 takesAnyVersion ? saved.generatorVersion : version};
    if (auto same = requireSame(saved, expected, where); !same) return tl::unexpected(same.error());
    if (wanted.regenerate != Regenerate::None || saved.generatorVersion == version)
        return Regeneration{wanted.regenerate, version};
    return Regeneration{Regenerate::AllButEdited, version, false};
}

}  // namespace terrane::store
