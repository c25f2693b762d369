// Rows of a store that follow from others: tiles, which are chunks of levels above 0, follow from the edited
// chunks of level 0. A store writes both in one transaction, so a save has the chunks and the rows that
// follow from them, or neither. All rows of levels above 0 count as derived.
//
// What the rows hold is told by the functions of DerivedRows, which a program gives to
// ChunkStore::setDerivedRows() before it saves edits, then calls ensureDerivedRows().
#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/world/chunk.h"
#include "terrane/world/coords.h"

namespace terrane::store {

class ChunkStore;

struct ChunkRow {
    world::ChunkPos pos;
    world::ChunkPtr chunk;  // null: there is none; of a derived row: the row is deleted
};

// The edited chunk or derived row that a store has at a position, as of its last durable batch: without what
// waits to be saved. Null where nothing edited is saved: a generated, damaged or absent row. To be called by
// derive() alone, while it runs and on its thread.
using ReadEdited = std::function<world::ChunkPtr(world::ChunkPos)>;

// The functions are never called twice at a time. They may load and save, but must not wait for the store:
// flush(), setDerivedRows() and deriveAll() would never return.
struct DerivedRows {
    // The rows, of levels above 0, that change with the edited chunks of level 0 that are about to be
    // written. Each position once. Called on the thread that writes, before each batch that has such chunks,
    // and again with newer ones when writing failed. May take long: only saves wait.
    std::function<std::vector<ChunkRow>(std::span<const ChunkRow> edited, const ReadEdited& saved)> derive;
    // The rows that derive() gave are in the store now. Same thread, after each batch that has some.
    std::function<void(std::span<const ChunkRow>)> written;
};

// World metadata that is there where all rows of levels above 0 follow from the edited chunks. The value
// names the rules by which they do. Stores alone write it: deriveAll() adds it; it goes with the first edits
// that are written without derive(), with rows that are put aside as damaged, and with a regeneration.
inline constexpr std::string_view kDerivedRowsMark = "tiles";

// Calls deriveAll() where the world lacks rows by these rules: it is new, was written by a program without
// them or with others, or has been regenerated. True where it did. To be called after setDerivedRows(),
// before rows of higher levels are loaded.
[[nodiscard]] base::Result<bool> ensureDerivedRows(ChunkStore& store, std::string_view rules);

// For stores. Derives the rows of all `edited` chunks, at most kDeriveGroup at a time, each group written
// before the next is derived. `saved` gives the chunks, and has to see the rows that are written.
constexpr std::size_t kDeriveGroup = 256;  // edited chunks of about 10 KB in memory: 2.5 MB
using WriteRows = std::function<base::Result<void>(std::span<const ChunkRow>)>;
[[nodiscard]] base::Result<void> deriveInGroups(const DerivedRows& rows, std::vector<world::ChunkPos> edited,
                                                const ReadEdited& saved, const WriteRows& write);

}  // namespace terrane::store
