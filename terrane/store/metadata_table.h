// The tables `settings` and `blocks` of an open save, and the checksum over both: the exclusive or of a hash
// of each row, kept in the setting `checksum`. A change of a row changes the checksum by the hashes of the
// old row and the new one, so that what broke in other rows stays found. Used by one thread at a time.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "terrane/store/block_id_map.h"
#include "terrane/store/metadata.h"
#include "terrane/store/sqlite.h"

namespace terrane::store {

inline constexpr std::string_view kChecksum = "checksum";

// Of all rows but kChecksum.
std::uint64_t metadataChecksum(const Metadata& metadata, std::span<const SavedName> names);

// An error where the checksum in `metadata` is missing or another one. An empty one is right: another program
// changed rows and left the checksum to those who know it.
[[nodiscard]] base::Result<void> verifyMetadata(const Metadata& metadata, std::span<const SavedName> names,
                                                const std::string& where);

// Writes the checksum of these rows.
[[nodiscard]] base::Result<void> writeChecksum(Database& database, std::uint64_t checksum);

// Changes rows, each with the checksum, in a transaction of the caller.
class MetadataTable {
  public:
    // Keeps `database`.
    [[nodiscard]] static base::Result<MetadataTable> make(Database& database);

    [[nodiscard]] base::Result<void> put(std::string_view name, std::string_view value);
    [[nodiscard]] base::Result<void> remove(std::string_view name);
    [[nodiscard]] base::Result<void> add(const SavedName& block);  // which is not there yet

  private:
    MetadataTable(Database& database, Statement select, Statement put, Statement remove, Statement addBlock)
        : database_(&database),
          select_(std::move(select)),
          put_(std::move(put)),
          remove_(std::move(remove)),
          addBlock_(std::move(addBlock)) {}
    base::Result<std::optional<std::string>> valueOf(std::string_view name);
    base::Result<std::uint64_t> hashOf(std::string_view name);  // of the row that is there; 0 for none
    base::Result<void> putRow(std::string_view name, std::string_view value);
    base::Result<void> changeChecksum(std::uint64_t by);

    Database* database_;
    Statement select_, put_, remove_, addBlock_;
};

}  // namespace terrane::store
