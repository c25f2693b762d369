#include "terrane/store/format_3.h"

#include <limits>
#include <optional>

#include "terrane/store/chunk_codec.h"
#include "terrane/store/chunk_key.h"
#include "terrane/store/chunk_reader.h"
#include "terrane/store/metadata_table.h"
#include "terrane/store/schema.h"

namespace terrane::store {
namespace {

struct Row {
    std::int64_t key = 0;
    Bytes data;  // empty: unchanged
};

// The first row at or after a key, with its new checksum. A row with a wrong checksum keeps it, so it is
// damaged in format 3, too.
base::Result<std::optional<Row>> nextRow(Statement& select, std::int64_t from) {
    const ResetAfter reset(select);
    select.bind(1, from);
    const auto isThere = TERRANE_TRY(select.step());
    if (!isThere) return std::optional<Row>();
    Row row;
    row.key = select.number(0);
    const bool isWhole = rowProblem(select, 2, 1).empty() && world::isInWorld(posOf(row.key));
    const ByteView data = select.blob(2);
    if (isWhole && verifyChunk(data, kFormerSeed)) {
        row.data.assign(data.begin(), data.end());
        sealChunk(row.data, checksumSeed(posOf(row.key), select.number(1) != 0));
    }
    return std::optional(std::move(row));
}

// Iterates by key, not by one statement over all rows, since rows change meanwhile.
base::Result<void> sealChunks(Database& database) {
    auto select = TERRANE_TRY(
        database.prepare("SELECT key, origin, data FROM chunks WHERE key >= ?1 ORDER BY key LIMIT 1"));
    auto update = TERRANE_TRY(database.prepare("UPDATE chunks SET data = ?2 WHERE key = ?1"));
    std::int64_t next = std::numeric_limits<std::int64_t>::min();
    while (true) {
        const auto row = TERRANE_TRY(nextRow(select, next));
        if (!row) return {};
        if (!row->data.empty()) {
            update.bind(1, row->key);
            update.bind(2, ByteView(row->data));
            TERRANE_TRY(update.run());
        }
        if (row->key == std::numeric_limits<std::int64_t>::max()) return {};
        next = row->key + 1;
    }
}

}  // namespace

base::Result<void> addChecksums(Database& database) {
    TERRANE_TRY(sealChunks(database));
    const auto metadata = TERRANE_TRY(readMetadata(database));
    const auto names = TERRANE_TRY(readBlockNames(database));
    return writeChecksum(database, metadataChecksum(metadata, names));
}

}  // namespace terrane::store
