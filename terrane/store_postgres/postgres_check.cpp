#include "terrane/store_postgres/postgres_check.h"

#include <limits>

#include "terrane/store/chunk_codec.h"
#include "terrane/store/chunk_key.h"
#include "terrane/store_postgres/postgres_rows.h"
#include "terrane/store_postgres/world_database.h"

namespace terrane::store_postgres {
namespace {

constexpr std::size_t kRowsCheckedAtOnce = 256;

constexpr Statement kSizes = {
    "SELECT (SELECT count(*) FROM quarantine), pg_total_relation_size('chunks'::regclass) + "
    "pg_total_relation_size('quarantine'::regclass)"};

std::string problemOf(const store::KeyedRow& row, const store::BlockIdMap& ids) {
    if (!world::isInWorld(store::posOf(row.key))) return fmt::format("the key {} is not a position", row.key);
    if (!row.row.problem.empty()) return row.row.problem;
    const auto chunk = store::decodeChunk(row.row.data, ids, row.row.seed);
    return chunk ? "" : chunk.error().message;
}

void addRow(store::CheckReport& report, const store::KeyedRow& row, const store::BlockIdMap& ids) {
    ++report.chunks;
    const bool isTile = row.key >= store::kFirstTileKey;
    if (isTile) ++report.tiles;
    if (!isTile && row.row.provenance == store::Provenance::Edited) ++report.editedChunks;
    report.chunkBytes += row.row.data.size();
    if (std::string problem = problemOf(row, ids); !problem.empty())
        store::addDamage(report, store::posOf(row.key), std::move(problem));
}

base::Result<void> checkChunks(WorldConnection& world, store::CheckReport& report) {
    std::int64_t key = std::numeric_limits<std::int64_t>::min();
    while (true) {
        const auto rows = TERRANE_TRY(readRowsAfter(world.connection, key, kRowsCheckedAtOnce));
        if (rows.empty()) return {};
        for (const store::KeyedRow& row : rows) addRow(report, row, world.contents.ids);
        key = rows.back().key;
    }
}

}  // namespace

base::Result<store::CheckReport> checkDatabase(const Address& address, const world::BlockRegistry& blocks) {
    store::CheckReport report;
    auto world = openToRead(address, blocks, ReadAs::Snapshot);
    if (!world) {
        if (world.error().code != base::ErrorCode::Damaged) return tl::unexpected(world.error());
        report.fileProblems.push_back(world.error().message);
        return report;
    }
    report.format = world->contents.format;
    report.identity = world->contents.identity;
    report.unknownBlocks = world->contents.ids.unknown();
    TERRANE_TRY(checkChunks(*world, report));
    const auto sizes = TERRANE_TRY(world->connection.run(kSizes));
    report.quarantined = static_cast<std::size_t>(sizes.number(0, 0));
    report.fileBytes = static_cast<std::uint64_t>(sizes.number(0, 1));
    return report;
}

}  // namespace terrane::store_postgres
