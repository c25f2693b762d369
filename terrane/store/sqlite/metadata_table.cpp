#include "terrane/store/sqlite/metadata_table.h"

#include <xxhash.h>

#include <charconv>
#include <string>
#include <utility>

namespace terrane::store {
namespace {

using base::ErrorCode;

std::uint64_t hashOfSetting(std::string_view name, std::string_view value) {
    std::string row(name);
    row += '\0';
    row += value;
    return XXH64(row.data(), row.size(), 0);
}

std::uint64_t hashOfBlock(const SavedName& block) {
    return XXH64(block.name.data(), block.name.size(), std::uint64_t{1} + block.id);
}

std::optional<std::uint64_t> checksumFrom(std::string_view text) {
    std::uint64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [next, error] = std::from_chars(text.data(), end, value);
    // Only the canonical form is valid.
    const bool isSame = error == std::errc() && next == end && std::to_string(value) == text;
    return isSame ? std::optional(value) : std::nullopt;
}

constexpr const char* kPut = "INSERT OR REPLACE INTO settings (name, value) VALUES (?1, ?2)";

}  // namespace

std::uint64_t metadataChecksum(const Metadata& metadata, std::span<const SavedName> names) {
    std::uint64_t sum = 0;
    for (const auto& [name, value] : metadata)
        if (name != kChecksum) sum ^= hashOfSetting(name, value);
    for (const SavedName& block : names) sum ^= hashOfBlock(block);
    return sum;
}

base::Result<void> verifyMetadata(const Metadata& metadata, std::span<const SavedName> names,
                                  const std::string& where) {
    const auto found = metadata.find(kChecksum);
    if (found == metadata.end())
        return base::fail(ErrorCode::Damaged, "{}: damaged: the setting {} is missing", where, kChecksum);
    if (found->second.empty() || checksumFrom(found->second) == metadataChecksum(metadata, names)) return {};
    return base::fail(ErrorCode::Damaged,
                      "{}: damaged: the checksum of its settings and block names is wrong", where);
}

base::Result<void> writeChecksum(Database& database, std::uint64_t checksum) {
    auto put = TERRANE_TRY(database.prepare(kPut));
    put.bind(1, kChecksum);
    put.bind(2, std::string_view(std::to_string(checksum)));
    return put.run();
}

base::Result<MetadataTable> MetadataTable::make(Database& database) {
    auto select = TERRANE_TRY(database.prepare("SELECT value FROM settings WHERE name = ?1"));
    auto put = TERRANE_TRY(database.prepare(kPut));
    auto remove = TERRANE_TRY(database.prepare("DELETE FROM settings WHERE name = ?1"));
    auto addBlock = TERRANE_TRY(database.prepare("INSERT INTO blocks (id, name) VALUES (?1, ?2)"));
    return MetadataTable(database, std::move(select), std::move(put), std::move(remove), std::move(addBlock));
}

base::Result<std::optional<std::string>> MetadataTable::valueOf(std::string_view name) {
    const ResetGuard reset(select_);
    select_.bind(1, name);
    const auto row = TERRANE_TRY(select_.step());
    return row ? std::optional(std::string(select_.text(0))) : std::nullopt;
}

base::Result<std::uint64_t> MetadataTable::hashOf(std::string_view name) {
    const auto value = TERRANE_TRY(valueOf(name));
    return value ? hashOfSetting(name, *value) : std::uint64_t{0};
}

base::Result<void> MetadataTable::putRow(std::string_view name, std::string_view value) {
    put_.bind(1, name);
    put_.bind(2, value);
    return put_.run();
}

base::Result<void> MetadataTable::changeChecksum(std::uint64_t by) {
    const auto text = TERRANE_TRY(valueOf(kChecksum));
    const auto sum = checksumFrom(text.value_or(""));
    if (!sum)
        return base::fail(ErrorCode::Damaged, "{}: damaged: the setting {} is \"{}\", expected a number",
                          database_->path(), kChecksum, text.value_or(""));
    return putRow(kChecksum, std::to_string(*sum ^ by));
}

base::Result<void> MetadataTable::put(std::string_view name, std::string_view value) {
    const auto before = TERRANE_TRY(hashOf(name));
    TERRANE_TRY(putRow(name, value));
    return changeChecksum(before ^ hashOfSetting(name, value));
}

base::Result<void> MetadataTable::remove(std::string_view name) {
    const auto before = TERRANE_TRY(hashOf(name));
    if (before == 0) return {};
    remove_.bind(1, name);
    TERRANE_TRY(remove_.run());
    return changeChecksum(before);
}

base::Result<void> MetadataTable::add(const SavedName& block) {
    addBlock_.bind(1, std::int64_t{block.id});
    addBlock_.bind(2, std::string_view(block.name));
    TERRANE_TRY(addBlock_.run());
    return changeChecksum(hashOfBlock(block));
}

}  // namespace terrane::store
