#include "terrane/net/sqlite_edits.h"

namespace terrane::net {
namespace {

std::string queryOf(const EditFilter& filter, EditOrder order) {
    std::string sql = fmt::format("SELECT number, time, player, chunk, blocks FROM edits WHERE number > {}",
                                  filter.afterNumber);
    if (filter.player) sql += fmt::format(" AND player = {}", *filter.player);
    if (filter.sinceMs) sql += fmt::format(" AND time >= {}", *filter.sinceMs);
    if (filter.untilMs) sql += fmt::format(" AND time < {}", *filter.untilMs);
    if (filter.area) {
        const KeyRange keys = chunkKeys(*filter.area);
        sql += fmt::format(" AND chunk BETWEEN {} AND {}", keys.first, keys.last);
    }
    return sql + (order == EditOrder::OldestFirst ? " ORDER BY number" : " ORDER BY number DESC");
}

}  // namespace

base::Result<void> forEachEdit(store::Database& database, const store::BlockIdMap& ids,
                               const EditFilter& filter, EditOrder order, const UseEdit& use) {
    const auto take = [&](const store::Statement& row) -> base::Result<void> {
        const auto edit = TERRANE_TRY(
            decodeEdit({row.number(0), row.number(1), row.number(2), row.number(3), row.blob(4)}, ids));
        return isInArea(edit, filter) ? use(edit) : base::Result<void>();
    };
    return store::forEachRow(database, queryOf(filter, order), take);
}

}  // namespace terrane::net
