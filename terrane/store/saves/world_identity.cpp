#include "terrane/store/saves/world_identity.h"

#include <charconv>

#include "terrane/base/digest.h"
#include "terrane/store/derived_rows.h"
#include "terrane/store/sqlite/metadata_table.h"

namespace terrane::store {

namespace {

using base::ErrorCode;

constexpr const char *kSeed = "seed", *kGenerator = "generator", *kGeneratorVersion = "generator_version",
                     *kBottom = "bottom", *kTop = "top";

// Error messages call metadata "settings", like the table in the file.
base::Result<std::string> textOf(const Metadata& metadata, const char* name, const std::string& where) {
    const auto found = metadata.find(name);
    if (found != metadata.end()) return found->second;
    return base::fail(ErrorCode::Damaged, "{}: damaged: the setting {} is missing", where, name);
}

template <class T>
std::optional<T> wholeNumber(std::string_view text) {
    T value{};
    const char* end = text.data() + text.size();
    const auto [next, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && next == end ? std::optional(value) : std::nullopt;
}

template <class T>
base::Result<T> numberOf(const Metadata& metadata, const char* name, const std::string& where) {
    const auto text = TERRANE_TRY(textOf(metadata, name, where));
    if (const auto value = wholeNumber<T>(text)) return *value;
    return base::fail(ErrorCode::Damaged, "{}: damaged: the setting {} is \"{}\", expected a number", where,
                      name, text);
}

// Worlds of 0…255 have neither entry.
base::Result<world::Heights> heightsFrom(const Metadata& metadata, const std::string& where) {
    if (!metadata.contains(kBottom) && !metadata.contains(kTop)) return world::Heights();
    world::Heights heights;
    heights.bottom = TERRANE_TRY(numberOf<int>(metadata, kBottom, where));
    heights.top = TERRANE_TRY(numberOf<int>(metadata, kTop, where));
    if (const auto good = world::checkHeights(heights); !good)
        return base::fail(ErrorCode::Damaged, "{}: damaged: {}", where, good.error().message);
    return heights;
}

bool isWholeNumber(std::string_view text) {
    if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
    return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
}

}  // namespace

base::Result<WrittenSeed> seedFrom(std::string_view text) {
    if (const auto seed = wholeNumber<std::uint64_t>(text)) return WrittenSeed{*seed, ""};
    if (const auto seed = wholeNumber<std::int64_t>(text))
        return WrittenSeed{static_cast<std::uint64_t>(*seed), ""};
    if (text.empty() || isWholeNumber(text))
        return base::fail(ErrorCode::BadInput,
                          "expected a whole number from {} to {}, or another text, got \"{}\"", INT64_MIN,
                          UINT64_MAX, text);
    return WrittenSeed{base::hash64(text), std::string(text)};
}

bool isReserved(std::string_view name) {
    return name == kSeed || name == kGenerator || name == kGeneratorVersion || name == kBottom ||
           name == kTop || name == kDerivedRowsMark || name == kChecksum;
}

bool fitsMetadata(const Metadata& metadata, std::string_view name, std::string_view value) {
    constexpr std::size_t kOwnRows = 2, kOwnBytes = 4096;  // kChecksum, kDerivedRowsMark
    std::size_t bytes = name.size() + value.size() + kOwnBytes, rows = metadata.size() + kOwnRows;
    for (const auto& [otherName, otherValue] : metadata)
        if (otherName != name) bytes += otherName.size() + otherValue.size();
    const bool isNew = !metadata.contains(name);
    return name.size() <= kMaxNameBytes && bytes <= kMaxMetadataBytes &&
           rows + (isNew ? 1 : 0) <= kMaxMetadata;
}

Metadata metadataOf(const WorldIdentity& identity) {
    Metadata metadata{{kSeed, std::to_string(identity.seed)},
                      {kGenerator, identity.generator},
                      {kGeneratorVersion, std::to_string(identity.generatorVersion)}};
    if (identity.heights != world::Heights()) {
        metadata.emplace(kBottom, std::to_string(identity.heights.bottom));
        metadata.emplace(kTop, std::to_string(identity.heights.top));
    }
    return metadata;
}

base::Result<WorldIdentity> identityFrom(const Metadata& metadata, const std::string& where) {
    const auto seed = TERRANE_TRY(numberOf<std::uint64_t>(metadata, kSeed, where));
    const auto version = TERRANE_TRY(numberOf<int>(metadata, kGeneratorVersion, where));
    const auto generator = TERRANE_TRY(textOf(metadata, kGenerator, where));
    const auto heights = TERRANE_TRY(heightsFrom(metadata, where));
    return WorldIdentity{seed, generator, version, heights};
}

base::Result<void> requireFormat(std::int64_t format, std::int64_t required, const WorldIdentity& identity,
                                 const std::string& where) {
    if (format == required) return {};
    return base::fail(ErrorCode::Damaged,
                      "{}: damaged: in format {}, but worlds of the layers {} have format {}", where, format,
                      world::describe(identity.heights), required);
}

base::Result<void> requireSame(const WorldIdentity& saved, const WorldIdentity& requested,
                               const std::string& where) {
    if (saved.generator != requested.generator)
        return base::fail(ErrorCode::Incompatible, "{}: made by the generator {}, not {}", where,
                          saved.generator, requested.generator);
    if (saved.seed != requested.seed)
        return base::fail(ErrorCode::Incompatible, "{}: made with seed {}, not {}", where, saved.seed,
                          requested.seed);
    if (saved.heights != requested.heights)
        return base::fail(ErrorCode::Incompatible, "{}: has the layers {}, not {}", where,
                          world::describe(saved.heights), world::describe(requested.heights));
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
                                 takesAnyVersion ? saved.generatorVersion : version,
                                 requested.heights.over(saved.heights)};
    TERRANE_TRY(requireSame(saved, expected, where));
    if (requested.regenerate != Regenerate::None || saved.generatorVersion == version)
        return Regeneration{requested.regenerate, version};
    return Regeneration{Regenerate::AllButEdited, version, false};
}

}  // namespace terrane::store
