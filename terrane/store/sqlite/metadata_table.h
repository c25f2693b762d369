// The tables `settings` and `blocks` of an open save, and their checksum: the XOR of a hash of each row,
// stored in the setting `checksum`. Changing a row updates the checksum by the hashes of the old and the new
// row, so damage in other rows is still detected. It is used by one thread at a time.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "terrane/store/chunks/block_id_map.h"
#include "terrane/store/saves/world_identity.h"
#include "terrane/store/sqlite/sqlite.h"

namespace terrane::store {

inline constexpr std::string_view kChecksum = "checksum";

// Returns the checksum of all rows except kChecksum.
std::uint64_t metadataChecksum(const Metadata& metadata, std::span<const SavedName> names);

// Fails if the checksum in `metadata` is missing or wrong. An empty one is valid: another program changed
// rows and cleared the checksum.
[[nodiscard]] base::Result<void> verifyMetadata(const Metadata& metadata, std::span<const SavedName> names,
                                                const std::string& where);

// Writes the checksum of these rows.
[[nodiscard]] base::Result<void> writeChecksum(Database& database, std::uint64_t checksum);

// Changes rows together with the checksum, in the caller's transaction.
class MetadataTable {
  public:
    // Creates the table, which keeps a reference to `database`.
    [[nodiscard]] static base::Result<MetadataTable> make(Database& database);

    [[nodiscard]] base::Result<void> put(std::string_view name, std::string_view value);
    [[nodiscard]] base::Result<void> remove(std::string_view name);
    [[nodiscard]] base::Result<void> add(const SavedName& block);  // must be new

  private:
    MetadataTable(Database& database, Statement select, Statement put, Statement remove, Statement addBlock)
        : database_(&database),
          select_(std::move(select)),
          put_(std::move(put)),
          remove_(std::move(remove)),
          addBlock_(std::move(addBlock)) {}
    base::Result<std::optional<std::string>> valueOf(std::string_view name);
    base::Result<std::uint64_t> hashOf(std::string_view name);  // of the existing row; 0: none
    base::Result<void> putRow(std::string_view name, std::string_view value);
    base::Result<void> changeChecksum(std::uint64_t by);

    Database* database_;
    Statement select_, put_, remove_, addBlock_;
};

}  // namespace terrane::store
