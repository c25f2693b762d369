// Derived rows of a store: tiles, which are chunks of levels above 0, are computed from the edited chunks of
// level 0. A store writes both in one transaction, so a save has both or neither. All rows of levels above 0
// are derived.
//
// A program passes the functions of DerivedRows to ChunkStore::setDerivedRows() before it saves edits, then
// calls ensureDerivedRows().
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
    world::ChunkPtr chunk;  // null: no chunk; for a derived row: delete it
};

// Reads the edited chunk or derived row at a position as of the last durable batch, without queued saves.
// Null if nothing edited is saved there (a generated, damaged or absent row). It is called by derive() only,
// on its thread.
using ReadEdited = std::function<world::ChunkPtr(world::ChunkPos)>;

// The functions are never called concurrently. They may load and save, but must not wait for the store:
// flush(), setDerivedRows() and deriveAll() would deadlock.
struct DerivedRows {
    // Returns the rows of levels above 0 that change with the `edited` chunks of level 0 that are about to be
    // written, each position once. Called on the writing thread before each batch with edited chunks, and
    // again with newer ones if writing failed. May take long: only saves wait.
    std::function<std::vector<ChunkRow>(std::span<const ChunkRow> edited, const ReadEdited& saved)> derive;
    // Called when rows of derive() are stored, on the same thread, after each batch that has some.
    std::function<void(std::span<const ChunkRow>)> written;
};

// World metadata that exists if all rows of levels above 0 are derived from the edited chunks; its value
// names the rules. Only stores write it: deriveAll() adds it; edits written without derive(), quarantined
// rows and a regeneration remove it.
inline constexpr std::string_view kDerivedRowsMark = "tiles";

// Calls deriveAll() if the world lacks rows by these rules: it is new, was written by a program without these
// rules or with others, or has been regenerated. Returns whether it called deriveAll(). Call after
// setDerivedRows(), before rows of higher levels are loaded.
[[nodiscard]] base::Result<bool> ensureDerivedRows(ChunkStore& store, std::string_view rules);

// Stores call it. Derives the rows of all `edited` chunks in groups of at most kDeriveGroup; each group is
// written before the next is derived. `saved` reads chunks and must see the written rows.
constexpr std::size_t kDeriveGroup = 256;  // edited chunks of about 10 KB in memory: 2.5 MB
using WriteRows = std::function<base::Result<void>(std::span<const ChunkRow>)>;
[[nodiscard]] base::Result<void> deriveInGroups(const DerivedRows& rows, std::vector<world::ChunkPos> edited,
                                                const ReadEdited& saved, const WriteRows& write);

}  // namespace terrane::store
