#include "terrane/net/server/edit_log.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <system_error>
#include <unordered_map>
#include <utility>

#include "terrane/net/server/known_players.h"
#include "terrane/net/server/sqlite_records.h"
#include "terrane/store/chunks/chunk_key.h"
#include "terrane/store/sqlite/schema.h"

namespace terrane::net {

namespace {

// Converts session ids to saved ids. A session has no types without a saved id.
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

// The first byte of an edit with blocks of other heights than 0…255. Others begin with their number of kinds
// of blocks, at least 1.
constexpr std::uint8_t kAnyHeights = 0;

IndexRange rangeOf(const LoggedEdit& edit) {
    const bool isLow = isWithin(edit.after, world::Heights()) && isWithin(edit.before, world::Heights());
    return isLow ? IndexRange::Low : IndexRange::Any;
}

bool haveSameBlocks(const LoggedEdit& edit) {
    return !edit.after.empty() &&
           std::ranges::equal(edit.before, edit.after, {}, &ChangedBlock::index, &ChangedBlock::index);
}

}  // namespace

Bytes encodeEdit(const LoggedEdit& edit, const store::BlockIdMap& ids) {
    Bytes bytes;
    WireWriter wire(bytes);
    const IndexRange range = rangeOf(edit);
    if (range == IndexRange::Any) wire.fixed(kAnyHeights);
    writeBlocks(wire, withSavedIds(edit.before, ids), range);
    writeBlocks(wire, withSavedIds(edit.after, ids), range);
    return bytes;
}

base::Result<LoggedEdit> decodeEdit(const EditRow& row, const store::BlockIdMap& ids) {
    const game::Author author = game::authorOf(static_cast<std::uint64_t>(row.author));
    LoggedEdit edit{row.number, row.timeMs, author.player, store::posOf(row.chunkKey), {}, {}, author.pack};
    const bool hasAnyHeights = !row.blocks.empty() && row.blocks.front() == std::byte{kAnyHeights};
    const IndexRange range = hasAnyHeights ? IndexRange::Any : IndexRange::Low;
    WireReader wire(hasAnyHeights ? row.blocks.subspan(1) : row.blocks);
    readBlocks(wire, edit.before, range);
    readBlocks(wire, edit.after, range);
    const bool isPlace = world::isInWorld(edit.chunk) && edit.chunk.level == 0;
    const bool isRead = wire.isComplete() && isPlace && haveSameBlocks(edit);
    if (isRead && takeSessionIds(edit.before, ids) && takeSessionIds(edit.after, ids)) return edit;
    return base::fail(base::ErrorCode::Damaged, "edit {} is damaged", edit.number);
}

bool isInArea(const LoggedEdit& edit, const EditFilter& filter) {
    return !filter.area || std::ranges::any_of(edit.after, [&](const ChangedBlock& block) {
        return filter.area->contains(world::blockPos(edit.chunk, block.index));
    });
}

base::Result<std::optional<LoggedEdit>> newestEdit(const ForEachEdit& forEachEdit, const EditFilter& filter) {
    std::optional<LoggedEdit> newest;
    const auto take = [&](const LoggedEdit& edit) -> base::Result<void> {
        newest = edit;
        return base::fail("found");  // ends the search
    };
    const auto searched = forEachEdit(filter, EditOrder::NewestFirst, take);
    if (!searched && !newest) return tl::unexpected(searched.error());
    return newest;
}

base::Result<void> selectSince(EditFilter& filter, const ForEachEdit& forEachEdit, std::int64_t sinceMs) {
    const auto before = TERRANE_TRY(newestEdit(forEachEdit, {.beforeMs = sinceMs}));
    if (before) filter.afterNumber = std::max(filter.afterNumber, before->number);
    return {};
}

// Keys are ordered by x first.
KeyRange chunkKeys(const game::ColumnArea& area) {
    const world::ChunkPos low{area.x0 >> 4, world::kMinChunk}, high{area.x1 >> 4, world::kMaxChunk};
    return {store::keyOf(low), store::keyOf(high)};
}

std::int64_t nowMs() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
}

std::int64_t authorNumber(const LoggedEdit& edit) {
    return static_cast<std::int64_t>(game::numberOf({edit.player, edit.pack}));
}

std::vector<LoggedEdit> loggedEdits(std::int64_t first, game::Author author, std::int64_t timeMs,
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
            edits.push_back({number, timeMs, author.player, chunk, part(before), part(after), author.pack});
            begin += count;
        }
    }
    return edits;
}

base::Result<std::vector<game::ChangedBlock>> rollback(const ForEachEdit& forEachEdit,
                                                       const EditFilter& filter) {
    std::unordered_map<world::BlockPos, game::ChangedBlock, world::BlockPosHash> blocks;
    const auto take = [&](const LoggedEdit& edit) -> base::Result<void> {
        for (std::size_t k = 0; k < edit.after.size(); ++k) {
            const world::BlockPos pos = world::blockPos(edit.chunk, edit.after[k].index);
            if (filter.area && !filter.area->contains(pos)) continue;
            // Edits come newest first: the first one seen gives `after`, the last one `before`.
            const auto found =
                blocks.try_emplace(pos, game::ChangedBlock{pos, {}, edit.after[k].value}).first;
            found->second.before = edit.before[k].value;
        }
        if (blocks.size() <= kMaxRollback) return {};
        return base::fail(base::ErrorCode::OutOfResources,
                          "more than {} blocks to roll back: choose a shorter time or a smaller area",
                          kMaxRollback);
    };
    TERRANE_TRY(forEachEdit(filter, EditOrder::NewestFirst, take));
    std::vector<game::ChangedBlock> plan;
    plan.reserve(blocks.size());
    for (auto& [pos, block] : blocks) plan.push_back(std::move(block));
    std::ranges::sort(plan, {}, [](const game::ChangedBlock& block) {
        return std::pair(world::chunkOf(block.pos), world::blockIndex(block.pos));
    });
    return plan;
}

base::Result<History> readHistoryFile(const std::filesystem::path& file, const world::BlockRegistry& blocks) {
    std::error_code error;
    if (!std::filesystem::exists(file, error))
        return base::fail(base::ErrorCode::NotFound,
                          "{}: there is no such file: no server has run this world", file.string());
    auto database = TERRANE_TRY(store::Database::open(file, store::OpenMode::ReadOnly));
    const auto names = TERRANE_TRY(store::readBlockNames(database));
    auto ids = store::BlockIdMap::make(blocks, names);
    if (!ids) return tl::unexpected(ids.error());
    History history;
    const auto take = [&](const store::Statement& row) -> base::Result<void> {
        history.names[static_cast<game::PlayerId>(row.number(0))] = row.text(1);
        return {};
    };
    TERRANE_TRY(store::forEachRow(database, "SELECT id, name FROM players", take));
    const auto kept = std::make_shared<store::Database>(std::move(database));
    history.forEachEdit = [kept, ids = std::move(*ids)](const EditFilter& filter, EditOrder order,
                                                        const UseEdit& use) {
        return forEachEdit(*kept, ids, filter, order, use);
    };
    return history;
}

std::optional<game::PlayerId> playerCalled(const History& history, std::string_view name) {
    for (const auto& [id, known] : history.names)
        if (isSameName(known, name)) return id;
    return std::nullopt;
}

std::string authorOf(const History& history, const LoggedEdit& edit) {
    const auto nameOf = [&](game::PlayerId player) {
        const auto found = history.names.find(player);
        return found == history.names.end() ? fmt::format("player {}", player) : found->second;
    };
    if (edit.pack == game::kNoPlayer)
        return edit.player == game::kNoPlayer ? "the server" : nameOf(edit.player);
    if (edit.player == game::kNoPlayer) return nameOf(edit.pack);
    return fmt::format("{} for {}", nameOf(edit.pack), nameOf(edit.player));
}

}  // namespace terrane::net
