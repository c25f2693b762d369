// The history of a shared world: who changed which blocks, when, from what to what. It is written before a
// command is acknowledged, so that it also brings back what a crash kept from the world's own file. Plain
// values, for any thread; server_records.h keeps them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "terrane/game/edit_history.h"
#include "terrane/game/permissions.h"
#include "terrane/net/chunk_difference.h"
#include "terrane/store/block_id_map.h"

namespace terrane::net {

// What one command changed in one chunk.
struct LoggedEdit {
    std::int64_t number = 0;  // ascending, from 1 on; the server gives it
    std::int64_t timeMs = 0;  // since 1970
    game::PlayerId player = game::kNoPlayer;
    world::ChunkPos chunk;
    ChunkDifference before, after;  // the same blocks
};

// One for each chunk, and more where a chunk's blocks are many. Their numbers begin with `first`.
std::vector<LoggedEdit> loggedEdits(std::int64_t first, game::PlayerId player, std::int64_t timeMs,
                                    std::span<const game::ChangedBlock> changes);

// Which edits are meant; what is not given makes no difference.
struct EditFilter {
    std::optional<game::PlayerId> player = {};
    std::optional<game::ColumnArea> area = {};  // some block of the edit is in it
    std::optional<std::int64_t> sinceMs = {}, untilMs = {};
    std::int64_t afterNumber = 0;
};
enum class EditOrder : std::uint8_t { OldestFirst, NewestFirst };

// Until `use` gives an error. An edit that cannot be read is an error that names its number.
using UseEdit = std::function<base::Result<void>(const LoggedEdit&)>;
using ForEachEdit = std::function<base::Result<void>(const EditFilter&, EditOrder, const UseEdit&)>;
// Whether some block of the edit is in the filter's area, of an edit that meets all else.
bool isInArea(const LoggedEdit& edit, const EditFilter& filter);
// The keys of chunks (store/chunk_key.h) in which the area is; others lie between them, too.
struct KeyRange {
    std::int64_t first = 0, last = 0;
};
KeyRange chunkKeys(const game::ColumnArea& area);

// The blocks of an edit as histories keep them, with the ids of `ids`.
Bytes encodeEdit(const LoggedEdit& edit, const store::BlockIdMap& ids);
// The edit of a row. Damaged where the bytes are not its blocks.
struct EditRow {
    std::int64_t number = 0, timeMs = 0, player = 0, chunkKey = 0;
    ByteView blocks;
};
[[nodiscard]] base::Result<LoggedEdit> decodeEdit(const EditRow& row, const store::BlockIdMap& ids);

// A block that a roll-back changes: from what the last of the edits made it to what it was before the first.
struct RolledBack {
    world::BlockPos pos;
    world::BlockValue made, before;
};
// At most so many blocks at once: about 200 bytes each while it runs, 400 MB.
constexpr std::size_t kMaxRollback = 2'000'000;
// By chunk, and in a chunk by block index. An error where there are too many.
[[nodiscard]] base::Result<std::vector<RolledBack>> rollback(const ForEachEdit& forEachEdit,
                                                             const EditFilter& filter);

}  // namespace terrane::net
