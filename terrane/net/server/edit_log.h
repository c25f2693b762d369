// The edit history of a shared world: player, time, and blocks before and after each change. An edit is
// written before its command is acknowledged, so the history also restores edits that a crash kept out of the
// world's store. Plain values, for any thread; server_records.h stores them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/game/edit_history.h"
#include "terrane/game/permissions.h"
#include "terrane/net/wire/chunk_difference.h"
#include "terrane/store/chunks/block_id_map.h"

namespace terrane::net {

// The blocks that one command changed in one chunk.
struct LoggedEdit {
    std::int64_t number = 0;  // ascending, from 1 on; assigned by the server
    std::int64_t timeMs = 0;  // since 1970
    game::PlayerId player = game::kNoPlayer;
    world::ChunkPos chunk;
    ChunkDifference before, after;  // the same block indices
    game::PlayerId pack =
        game::kNoPlayer;  // the number of a pack among the players, if its rules changed them
};
// The number that the history stores for the player and the pack.
std::int64_t authorNumber(const LoggedEdit& edit);

// The current time as in LoggedEdit::timeMs.
std::int64_t nowMs();
// A time of an edit that is so far ahead of the clock is worth a warning.
constexpr std::int64_t kWarnedOfDateMs = 60'000;
// The year 9999: later times of a damaged history are not continued.
constexpr std::int64_t kLastDateMs = 253'402'300'799'000;
// One edit for each chunk, more if a chunk has many changed blocks. Numbers start at `first`.
std::vector<LoggedEdit> loggedEdits(std::int64_t first, game::Author author, std::int64_t timeMs,
                                    std::span<const game::ChangedBlock> changes);

// Selects edits. A field without a value does not restrict the selection.
struct EditFilter {
    std::optional<game::PlayerId> player = {};  // or a pack
    std::optional<game::ColumnArea> area = {};  // contains at least one block of the edit
    std::optional<std::int64_t> beforeMs = {};  // its time is earlier
    std::int64_t afterNumber = 0;
};
enum class EditOrder : std::uint8_t { OldestFirst, NewestFirst };

// Calls `use` for each edit until it returns an error. An unreadable edit is an error that names its number.
using UseEdit = std::function<base::Result<void>(const LoggedEdit&)>;
using ForEachEdit = std::function<base::Result<void>(const EditFilter&, EditOrder, const UseEdit&)>;
// Whether a block of the edit is in the filter's area, for an edit that matches the rest of the filter.
bool isInArea(const LoggedEdit& edit, const EditFilter& filter);
// Range of chunk keys (store/chunk_key.h) that covers the area; it also contains keys outside the area.
struct KeyRange {
    std::int64_t first = 0, last = 0;
};
KeyRange chunkKeys(const game::ColumnArea& area);

// The newest edit that the filter selects; none if there is no such edit.
[[nodiscard]] base::Result<std::optional<LoggedEdit>> newestEdit(const ForEachEdit& forEachEdit,
                                                                 const EditFilter& filter);
// Restricts the filter to the edits since a time. Which edits these are follows from their order, since dates
// may have been wrong for a while: an edit is older than all with greater numbers, whatever time it has.
[[nodiscard]] base::Result<void> selectSince(EditFilter& filter, const ForEachEdit& forEachEdit,
                                             std::int64_t sinceMs);

// Encodes the blocks of an edit with the saved ids of `ids`. Edits within 0…255 have the same bytes in worlds
// of all heights.
Bytes encodeEdit(const LoggedEdit& edit, const store::BlockIdMap& ids);
// A row of the edit table. decodeEdit() returns ErrorCode::Damaged if the bytes are not valid.
struct EditRow {
    std::int64_t number = 0, timeMs = 0, author = 0, chunkKey = 0;
    ByteView blocks;
};
[[nodiscard]] base::Result<LoggedEdit> decodeEdit(const EditRow& row, const store::BlockIdMap& ids);

// Maximum number of blocks in one rollback: 2,000,000 × about 200 bytes = 400 MB.
constexpr std::size_t kMaxRollback = 2'000'000;
// Computes a rollback, sorted by chunk, then block index. Fails if there are more than kMaxRollback blocks.
[[nodiscard]] base::Result<std::vector<game::ChangedBlock>> rollback(const ForEachEdit& forEachEdit,
                                                                     const EditFilter& filter);

// Read access to the edit history of a world's servers, also while they run. One thread at a time.
struct History {
    std::map<game::PlayerId, std::string> names;
    ForEachEdit forEachEdit;  // as ServerRecords::forEachEdit()
};

// Opens the history in a server's file. Errors name the file.
[[nodiscard]] base::Result<History> readHistoryFile(const std::filesystem::path& file,
                                                    const world::BlockRegistry& blocks);

std::optional<game::PlayerId> playerCalled(const History& history, std::string_view name);  // ignores case
// "Ann", "the server", "pack:isles", "pack:isles for Ann".
std::string authorOf(const History& history, const LoggedEdit& edit);

}  // namespace terrane::net
