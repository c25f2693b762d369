#include "terrane/store_postgres/postgres_store.h"

#include <limits>
#include <utility>

#include "terrane/store/chunks/chunk_codec.h"
#include "terrane/store/chunks/chunk_key.h"
#include "terrane/store_postgres/postgres_rows.h"
#include "terrane/store_postgres/postgres_writer.h"
#include "terrane/store_postgres/world_database.h"

namespace terrane::store_postgres {

namespace {

using world::ChunkPos;

// Shared by readers and writers; `Base` is store::ReadableRows or store::ChunkRows.
template <class Base>
class PostgresReadRows : public Base {
  public:
    PostgresReadRows(const Address& address, RetryTimes times, WorldContents contents)
        : pool_(address, times), contents_(std::move(contents)) {}

    const std::string& name() const override { return pool_.address().shown; }
    const store::WorldIdentity& identity() const override { return contents_.identity; }
    const store::Metadata& metadata() const override { return contents_.metadata; }
    const store::BlockIdMap& ids() const override { return contents_.ids; }
    store::StoredRow read(ChunkPos pos) override { return queries_.read(pos); }
    void readMany(std::span<const ChunkPos> positions, const store::ReadableRows::TakeRow& take) override {
        queries_.readMany(positions, take);
    }
    base::Result<bool> contains(ChunkPos pos) override { return queries_.contains(pos); }
    base::Result<std::vector<ChunkPos>> editedChunks() override { return queries_.editedChunks(); }
    base::Result<std::vector<store::KeyedRow>> rowsAfter(std::int64_t key, std::size_t count) override {
        return queries_.rowsAfter(key, count);
    }
    base::Result<std::uint64_t> rowCount() override { return queries_.rowCount(); }

  protected:
    ConnectionPool pool_;
    WorldContents contents_;

  private:
    ChunkQueries queries_{pool_};
};

class PostgresRows : public PostgresReadRows<store::ChunkRows> {
  public:
    PostgresRows(const Address& address, RetryTimes times, WorldConnection opened,
                 store::WorldSharing sharing)
        : PostgresReadRows(address, times, std::move(opened.contents)),
          writer_(pool_, contents_, std::move(opened.connection), sharing) {}

    base::Result<bool> write(const store::SaveBatch& batch, const store::ChunkPosSet& unread,
                             const store::DeriveBatch& derive) override {
        return writer_.write(batch, unread, derive);
    }
    base::Result<void> deriveAll(const store::DerivedRows& rows, std::string_view rules,
                                 store::EntityBudget& budget) override {
        return writer_.deriveAll(rows, rules, budget);
    }
    std::int64_t newestEdit() const { return contents_.newestEdit; }
    base::Result<void> change(const store::RowChanges& changes) override { return writer_.change(changes); }

  private:
    PostgresWriter writer_;
};

}  // namespace

namespace {

base::Result<std::unique_ptr<PostgresRows>> openPostgresRows(const Address& address,
                                                             const world::BlockRegistry& blocks,
                                                             const store::SaveAccess& access,
                                                             store::WorldSharing sharing, RetryTimes times) {
    auto opened = TERRANE_TRY(openToWrite(address, blocks, access, sharing));
    return std::make_unique<PostgresRows>(address, times, std::move(opened), sharing);
}

}  // namespace

base::Result<std::unique_ptr<store::ChunkRows>> openRows(const Address& address,
                                                         const world::BlockRegistry& blocks,
                                                         const store::SaveAccess& access,
                                                         store::WorldSharing sharing, RetryTimes times) {
    auto rows = TERRANE_TRY(openPostgresRows(address, blocks, access, sharing, times));
    return rows;
}

base::Result<std::unique_ptr<store::ReadableRows>> openRowsToRead(const Address& address,
                                                                  const world::BlockRegistry& blocks,
                                                                  RetryTimes times) {
    auto opened = TERRANE_TRY(openToRead(address, blocks));
    return std::make_unique<PostgresReadRows<store::ReadableRows>>(address, times,
                                                                   std::move(opened.contents));
}

base::Result<std::unique_ptr<PostgresStore>> PostgresStore::open(
    const Address& address, const world::BlockRegistry& blocks, const store::SaveAccess& access,
    store::WorldSharing sharing, const store::SaveLimits& limits, RetryTimes times) {
    auto rows = TERRANE_TRY(openPostgresRows(address, blocks, access, sharing, times));
    const std::int64_t version = rows->newestEdit();
    std::unique_ptr<PostgresStore> store(new PostgresStore(std::move(rows), limits));
    store->setVersion(version);
    return store;
}

base::Result<std::unique_ptr<store::ReadableStore>> openReader(const Address& address,
                                                               const world::BlockRegistry& blocks,
                                                               const store::SaveLimits& limits,
                                                               RetryTimes times) {
    auto rows = TERRANE_TRY(openRowsToRead(address, blocks, times));
    return std::make_unique<store::RowsReader>(std::move(rows), limits);
}

namespace {

constexpr std::size_t kRowsCheckedAtOnce = 256;

constexpr Statement kSizes = {
    "SELECT (SELECT count(*) FROM quarantine), pg_total_relation_size('chunks'::regclass) + "
    "pg_total_relation_size('quarantine'::regclass)"};

std::string problemOf(const store::KeyedRow& row, const WorldContents& world) {
    if (!world::isInWorld(store::posOf(row.key))) return fmt::format("the key {} is not a position", row.key);
    if (!row.row.problem.empty()) return row.row.problem;
    const auto chunk = store::decodeChunk(row.row.data, world.ids, world.identity.heights, row.row.seed);
    return chunk ? "" : chunk.error().message;
}

void addRow(store::CheckReport& report, const store::KeyedRow& row, const WorldContents& world) {
    ++report.chunks;
    const bool isTile = row.key >= store::kFirstTileKey;
    if (isTile) ++report.tiles;
    if (!isTile && row.row.provenance == store::Provenance::Edited) ++report.editedChunks;
    report.chunkBytes += row.row.data.size();
    if (std::string problem = problemOf(row, world); !problem.empty())
        store::addDamage(report, store::posOf(row.key), std::move(problem));
}

base::Result<void> checkChunks(WorldConnection& world, store::CheckReport& report) {
    std::int64_t key = std::numeric_limits<std::int64_t>::min();
    while (true) {
        const auto rows = TERRANE_TRY(readRowsAfter(world.connection, key, kRowsCheckedAtOnce));
        if (rows.empty()) return {};
        for (const store::KeyedRow& row : rows) addRow(report, row, world.contents);
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
