// The interface of the stores of a world's chunks and metadata between sessions. SqliteStore stores them in a
// file, MemoryStore until the program ends, OverlayStore in memory over another store. open_world.h opens the
// store for a location. All of them pass the tests of tests/store/chunk_store_contract_test.cpp.
//
// Any thread may call everything.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/store/derived_rows.h"
#include "terrane/store/saves/world_identity.h"
#include "terrane/world/chunk.h"
#include "terrane/world/coords.h"

namespace terrane::store {

enum class Provenance : std::uint8_t {
    Generated,  // can be generated again
    Edited,
};
// The values of the column `origin` in SQL and in checksumSeed().
static_assert(static_cast<int>(Provenance::Generated) == 0 && static_cast<int>(Provenance::Edited) == 1);

struct LoadedChunk {
    enum class State : std::uint8_t {
        Absent,   // never saved: must be generated
        Present,  // in `chunk`
        Damaged,  // see `problem`; the row is quarantined: must be generated
    };
    State state = State::Absent;
    std::shared_ptr<world::Chunk> chunk;  // owned by the caller, who may change it
    Provenance provenance = Provenance::Generated;
    std::string problem;
    // If damaged: the row could not be read now and may be intact. It stays in place.
    bool isUnreadable = false;
    bool isOverBudget = false;  // unread because of SaveLimits::entityBytes
};

// Returns a copy of the chunk as load() returns it; Absent for null.
LoadedChunk loadedCopy(const world::ChunkPtr& chunk, Provenance provenance);

// Returns "chunk 5,-6", or at higher levels "chunk 5,-6 of level 2".
std::string nameOf(world::ChunkPos pos);

// Returns the `positions` that must be generated, because nothing is stored or the stored row is damaged.
// `stored` has the results of loadMany(). A chunk over the memory budget counts as damaged; its row stays.
// Returns Io if a chunk could not be read for another reason: it may exist, and a generated one would not be
// saved.
[[nodiscard]] base::Result<std::vector<world::ChunkPos>> missingChunks(
    std::span<const world::ChunkPos> positions, std::span<const LoadedChunk> stored);

// Read access to a world.
class ReadableStore {
  public:
    virtual ~ReadableStore() = default;

    // Loads a chunk: reads and decodes it on the calling thread, which takes about 50 µs, over a network
    // milliseconds. The result includes all earlier saves, durable or not.
    virtual LoadedChunk load(world::ChunkPos pos) = 0;
    // Returns the same as load() of each position, in their order, but reads in one transaction, or one round
    // trip over a network. A job loads its chunks with one call.
    virtual std::vector<LoadedChunk> loadMany(std::span<const world::ChunkPos> positions);
    virtual bool contains(world::ChunkPos pos) = 0;  // whether load() finds a row; does not read the chunk
    // Returns the edited chunks of level 0, ordered by x, then y, without unsaved ones. Scans all rows of a
    // file.
    [[nodiscard]] virtual base::Result<std::vector<world::ChunkPos>> editedChunks() = 0;

    // Returns a small text by its name, for example the player's position.
    virtual std::optional<std::string> metadata(std::string_view name) = 0;
    virtual const WorldIdentity& identity() const = 0;
};

// Saves are numbered from 1 in the order of the calls.
using SaveNumber = std::uint64_t;

struct SaveStatus {
    SaveNumber queued = 0;      // the newest save
    SaveNumber durable = 0;     // it and all earlier ones survive a program or power failure
    std::size_t waiting = 0;    // chunks not durable yet
    std::string problem;        // why the last write failed; empty if it succeeded
    double failingSeconds = 0;  // since the first failed attempt
};

// The destructor writes all queued saves.
class ChunkStore : public ReadableStore {
  public:
    // Queues the snapshot without blocking; it replaces a queued older one of the same position. A generated
    // chunk never replaces an edited one.
    virtual SaveNumber save(world::ChunkPos pos, world::ChunkPtr chunk, Provenance provenance) = 0;

    // Sets metadata, which is saved in order with chunks. The metadata of identity() (seed, generator,
    // generator_version) and kDerivedRowsMark cannot be set: an attempt is logged as an error and changes
    // nothing.
    virtual SaveNumber setMetadata(std::string_view name, std::string value) = 0;

    // Until the result is destroyed, no write begins: the saves of this time are written in one transaction.
    // Not to be held for long, and flush() not to be called meanwhile.
    [[nodiscard]] virtual std::shared_ptr<void> together() { return nullptr; }

    // Blocks until all queued saves are durable, or an attempt to write failed.
    [[nodiscard]] virtual base::Result<void> flush() = 0;
    virtual SaveStatus status() = 0;

    // Sets the functions of derived rows: from now on, these rows are written in one transaction with the
    // edited chunks that they depend on. Empty functions disable this. Returns when no previous function is
    // running any more.
    virtual void setDerivedRows(DerivedRows rows) = 0;
    // Deletes all rows of levels above 0 and derives them again from all edited chunks, in one transaction,
    // on the calling thread; written() is not called. Saves wait meanwhile. Sets kDerivedRowsMark to `rules`.
    // Call setDerivedRows() first.
    [[nodiscard]] virtual base::Result<void> deriveAll(std::string_view rules) = 0;

    // A server calls it in a world that several servers write: it declares that later saves include all edits
    // of the history up to this one. A late older snapshot never replaces a newer one. Other stores ignore
    // it.
    virtual void setVersion(std::int64_t /*newestEdit*/) {}

    virtual bool isPersistent() const = 0;  // false: all is lost when the program ends
};

}  // namespace terrane::store
