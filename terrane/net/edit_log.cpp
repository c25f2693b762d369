#include "terrane/net/edit_log.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include "terrane/store/chunk_key.h"

namespace terrane::net {
namespace {

constexpr const char* kSaved = "saved";  // in the table `state`

// Ids as the file has them. Types that the file has no id for are none that a session can have.
ChunkDifference withSavedIds(ChunkDifference blocks, const store::BlockIdMap& ids) {
    for (ChangedBlock& block : blocks)
        block.value.id = static_cast<world::BlockId>(ids.toSaved(block.value.id));
    return blocks;
}

bool takeSessionIds(ChunkDifference& blocks, const store::BlockIdMap& ids) {
    for (ChangedBlock& block : blocks) {
        const std::uint32_t id = ids.toSession(block.value.id);
        if (id == store::BlockIdMap::kNone) return false;
        block.value.id = static_cast<world::BlockId>(id);
    }
    return true;
}

Bytes encodeBlocks(const LoggedEdit& edit, const store::BlockIdMap& ids) {
    Bytes bytes;
    WireWriter wire(bytes);
    writeBlocks(wire, withSavedIds(edit.before, ids));
    writeBlocks(wire, withSavedIds(edit.after, ids));
    return bytes;
}

bool haveSameBlocks(const LoggedEdit& edit) {
    return std::ranges::equal(edit.before, edit.after, {}, &ChangedBlock::index, &ChangedBlock::index);
}

base::Result<LoggedEdit> editOf(const store::Statement& row, const store::BlockIdMap& ids) {
    LoggedEdit edit{row.number(0),
                    row.number(1),
                    static_cast<game::PlayerId>(row.number(2)),
                    store::posOf(row.number(3)),
                    {},
                    {}};
    WireReader wire(row.blob(4));
    readBlocks(wire, edit.before);
    readBlocks(wire, edit.after);
    const bool isRead = wire.isComplete() && world::isInWorld(edit.chunk) && haveSameBlocks(edit);
    if (isRead && takeSessionIds(edit.before, ids) && takeSessionIds(edit.after, ids)) return edit;
    return base::fail(base::ErrorCode::Damaged, "edit {} is damaged", edit.number);
}

bool isInArea(const LoggedEdit& edit, const game::ColumnArea& area) {
    return std::ranges::any_of(edit.after, [&](const ChangedBlock& block) {
        return area.contains(world::blockPos(edit.chunk, block.index));
    });
}

std::string queryOf(const EditFilter& filter, EditOrder order) {
    std::string sql = fmt::format("SELECT number, time, player, chunk, blocks FROM edits WHERE number > {}",
                                  filter.afterNumber);
    if (filter.player) sql += fmt::format(" AND player = {}", *filter.player);
    if (filter.sinceMs) sql += fmt::format(" AND time >= {}", *filter.sinceMs);
    if (filter.untilMs) sql += fmt::format(" AND time < {}", *filter.untilMs);
    if (filter.area) {  // a key grows with x first
        const world::ChunkPos low{filter.area->x0 >> 4, world::kMinChunk},
            high{filter.area->x1 >> 4, world::kMaxChunk};
        sql += fmt::format(" AND chunk BETWEEN {} AND {}", store::keyOf(low), store::keyOf(high));
    }
    return sql + (order == EditOrder::OldestFirst ? " ORDER BY number" : " ORDER BY number DESC");
}

base::Result<std::int64_t> numberOr0(store::Database& database, const std::string& sql) {
    const auto number = database.queryNumber(sql);
    if (!number) return tl::unexpected(number.error());
    return number->value_or(0);
}

}  // namespace

std::vector<LoggedEdit> loggedEdits(std::int64_t first, game::PlayerId player, std::int64_t timeMs,
                                    std::span<const game::ChangedBlock> changes) {
    std::map<world::ChunkPos, std::vector<const game::ChangedBlock*>> chunks;
    for (const game::ChangedBlock& change : changes) chunks[world::chunkOf(change.pos)].push_back(&change);
    std::vector<LoggedEdit> edits;
    for (auto& [chunk, blocks] : chunks) {
        std::ranges::sort(blocks, {}, [](const auto* block) { return world::blockIndex(block->pos); });
        ChunkDifference before, after;
        for (const auto* block : blocks) {
            before.push_back({world::blockIndex(block->pos), block->before});
            after.push_back({world::blockIndex(block->pos), block->after});
        }
        for (std::size_t begin = 0; begin < before.size();) {
            const std::size_t count = std::min(partsOf(std::span(before).subspan(begin)).front().size(),
                                               partsOf(std::span(after).subspan(begin)).front().size());
            const auto part = [&](const ChunkDifference& all) {
                const auto from = all.begin() + static_cast<std::ptrdiff_t>(begin);
                return ChunkDifference(from, from + static_cast<std::ptrdiff_t>(count));
            };
            const auto number = first + static_cast<std::int64_t>(edits.size());
            edits.push_back({number, timeMs, player, chunk, part(before), part(after)});
            begin += count;
        }
    }
    return edits;
}

std::uint64_t appendEdit(ServerFile& file, LoggedEdit edit) {
    Bytes blocks = encodeBlocks(edit, file.ids());
    assert(edit.number > 0 && "the server numbers edits");
    return file.write([number = edit.number, time = edit.timeMs, player = std::int64_t{edit.player},
                       chunk = store::keyOf(edit.chunk),
                       blocks = std::move(blocks)](store::Database& database) -> base::Result<void> {
        auto insert = database.prepare(
            "INSERT INTO edits (number, time, player, chunk, blocks) VALUES (?1, ?2, ?3, ?4, ?5)");
        if (!insert) return tl::unexpected(insert.error());
        insert->bind(1, number);
        insert->bind(2, time);
        insert->bind(3, player);
        insert->bind(4, chunk);
        insert->bind(5, blocks);
        return insert->run();
    });
}

base::Result<std::int64_t> newestEdit(store::Database& database) {
    return numberOr0(database, "SELECT max(number) FROM edits");
}

base::Result<std::int64_t> savedEdit(store::Database& database) {
    return numberOr0(database, fmt::format("SELECT value FROM state WHERE name = '{}'", kSaved));
}

std::uint64_t setSavedEdit(ServerFile& file, std::int64_t number) {
    return file.write([number](store::Database& database) {
        return database.execute(
            fmt::format("INSERT OR REPLACE INTO state (name, value) VALUES ('{}', {})", kSaved, number));
    });
}

base::Result<void> forEachEdit(store::Database& database, const store::BlockIdMap& ids,
                               const EditFilter& filter, EditOrder order, const UseEdit& use) {
    const auto take = [&](const store::Statement& row) -> base::Result<void> {
        const auto edit = editOf(row, ids);
        if (!edit) return tl::unexpected(edit.error());
        return filter.area && !isInArea(*edit, *filter.area) ? base::Result<void>() : use(*edit);
    };
    return store::forEachRow(database, queryOf(filter, order), take);
}

base::Result<std::vector<RolledBack>> rollback(store::Database& database, const store::BlockIdMap& ids,
                                               const EditFilter& filter) {
    std::unordered_map<world::BlockPos, RolledBack, world::BlockPosHash> blocks;
    const auto take = [&](const LoggedEdit& edit) -> base::Result<void> {
        for (std::size_t k = 0; k < edit.after.size(); ++k) {
            const world::BlockPos pos = world::blockPos(edit.chunk, edit.after[k].index);
            if (filter.area && !filter.area->contains(pos)) continue;
            // From the newest on: the first is what the block was made, the last what it was.
            const auto found = blocks.try_emplace(pos, RolledBack{pos, edit.after[k].value, {}}).first;
            found->second.before = edit.before[k].value;
        }
        if (blocks.size() <= kMaxRollback) return {};
        return base::fail(base::ErrorCode::OutOfResources,
                          "more than {} blocks to roll back: say a shorter time or a smaller area",
                          kMaxRollback);
    };
    if (auto done = forEachEdit(database, ids, filter, EditOrder::NewestFirst, take); !done)
        return tl::unexpected(done.error());
    std::vector<RolledBack> plan;
    plan.reserve(blocks.size());
    for (auto& [pos, block] : blocks) plan.push_back(std::move(block));
    std::ranges::sort(plan, {}, [](const RolledBack& block) {
        return std::pair(world::chunkOf(block.pos), world::blockIndex(block.pos));
    });
    return plan;
}

}  // namespace terrane::net
