// Copies a world in a database into files, as of one moment. Declared in world_records.h.
#include <limits>

#include "terrane/net/server/sqlite_records.h"
#include "terrane/net_postgres/record_rows.h"
#include "terrane/net_postgres/world_records.h"
#include "terrane/store/saves/world_copy.h"
#include "terrane/store/sqlite/sqlite_store.h"
#include "terrane/store_postgres/postgres_rows.h"
#include "terrane/store_postgres/world_database.h"

namespace terrane::net_postgres {
namespace {

using store_postgres::WorldConnection;

// About 1 to 10 KB each.
constexpr std::size_t kRowsOfCopy = 512;

// The records that the transaction of a connection sees.
class RecordsOfMoment : public net::ReadableRecords {
  public:
    explicit RecordsOfMoment(WorldConnection& world) : world_(world) {}

    base::Result<std::vector<net::KnownPlayer>> players() override { return readPlayers(world_.connection); }
    base::Result<std::vector<game::Claim>> claims() override { return readClaims(world_.connection); }
    base::Result<std::string> text(const std::string& name) override {
        return readText(world_.connection, name);
    }
    base::Result<net::HistoryEnds> historyEnds() override { return readEnds(world_.connection); }
    base::Result<void> forEachEdit(const net::EditFilter& filter, net::EditOrder order,
                                   const net::UseEdit& use) override {
        return net_postgres::forEachEdit(
            [&](std::optional<std::int64_t> last) {
                return readEdits(world_.connection, world_.contents.ids, filter, order, last);
            },
            use);
    }

  private:
    WorldConnection& world_;
};

// Rows byte for byte, as they are. Those that are too long to be chunks are left out.
base::Result<void> copyRowsOfMoment(WorldConnection& world, store::ChunkRows& to,
                                    const store::CopyProgress& progress) {
    std::int64_t key = std::numeric_limits<std::int64_t>::min();
    while (true) {
        store::RowChanges changes;
        auto rows = TERRANE_TRY(store_postgres::readRowsAfter(world.connection, key, kRowsOfCopy));
        if (rows.empty()) break;
        key = rows.back().key;
        std::erase_if(rows, [](const store::KeyedRow& row) { return !row.row.problem.empty(); });
        changes.rows = std::move(rows);
        TERRANE_TRY(to.change(changes));
        if (progress && !progress(0)) return base::fail("{}: the copy was cancelled", to.name());
    }
    store::RowChanges settings;
    settings.metadata = world.contents.metadata;
    return to.change(settings);
}

}  // namespace

base::Result<void> copyDatabase(const store::WorldLocation& world, const world::BlockRegistry& blocks,
                                const std::filesystem::path& save, const store::CopyProgress& progress) {
    const auto address = TERRANE_TRY(store_postgres::addressOf(world.text));
    auto from = TERRANE_TRY(store_postgres::openToRead(address, blocks, store_postgres::ReadAs::Snapshot));
    const auto mark = from.contents.metadata.find(store::kCopyMark);
    if (mark != from.contents.metadata.end() && mark->second.starts_with(store::kUnfinishedCopy))
        return base::fail(base::ErrorCode::Incompatible, "{}: an unfinished copy; start it again",
                          address.shown);
    {
        store::SaveAccess access;
        access.create = from.contents.identity;
        access.blockNames = from.contents.ids.names();
        const auto to = TERRANE_TRY(store::openSqliteRows(save, blocks, access));
        TERRANE_TRY(copyRowsOfMoment(from, *to, progress));
    }
    RecordsOfMoment records(from);
    const auto players = TERRANE_TRY(records.players());
    if (players.empty()) return {};  // no server has run
    const auto to = TERRANE_TRY(net::SqliteRecords::open(store::serverFilePath(save), blocks));
    return net::copyRecords(records, *to, net::WorldOfCopy::MayLackEdits).map([](const net::RecordsCopied&) {
    });
}

}  // namespace terrane::net_postgres
