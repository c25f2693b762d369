#include "terrane/store/metadata.h"

#include <charconv>

#include "terrane/store/derived_rows.h"
#include "terrane/store/metadata_table.h"

namespace terrane::store {
namespace {

using base::ErrorCode;

constexpr const char *kSeed = "seed", *kGenerator = "generator", *kGeneratorVersion = "generator_version";

// Error messages call metadata "settings", like the table in the file.
base::Result<std::string> textOf(const Metadata& metadata, const char* name, const std::string& where) {
    const auto found = metadata.find(name);
    if (found != metadata.end()) return found->second;
    return base::fail(ErrorCode::Damaged, "{}: damaged: the setting {} is missing", where, name);
}

template <class T>
base::Result<T> numberOf(const Metadata& metadata, const char* name, const std::string& where) {
    const auto text = TERRANE_TRY(textOf(metadata, name, where));
    T value{};
    const char* end = text.data() + text.size();
    const auto [next, error] = std::from_chars(text.data(), end, value);
    if (error == std::errc() && next == end) return value;
    return base::fail(ErrorCode::Damaged, "{}: damaged: the setting {} is \"{}\", expected a number", where,
                      name, text);
}

}  // namespace

bool isReserved(std::string_view name) {
    return name == kSeed || name == kGenerator || name == kGeneratorVersion || name == kDerivedRowsMark ||
           name == kChecksum;
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
    return {{kSeed, std::to_string(identity.seed)},
            {kGenerator, identity.generator},
            {kGeneratorVersion, std::to_string(identity.generatorVersion)}};
}

base::Result<WorldIdentity> identityFrom(const Metadata& metadata, const std::string& where) {
    const auto seed = TERRANE_TRY(numberOf<std::uint64_t>(metadata, kSeed, where));
    const auto version = TERRANE_TRY(numberOf<int>(metadata, kGeneratorVersion, where));
    const auto generator = TERRANE_TRY(textOf(metadata, kGenerator, where));
    return WorldIdentity{seed, generator, version};
}

}  // namespace terrane::store
