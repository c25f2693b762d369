// Where chunks and what belongs to a world are kept between sessions. SqliteStore keeps them in a file,
// MemoryStore until the program ends, OverlayStore in memory over what another store has. open_world.h opens
// the one for a location. All of these pass the tests of tests/store/chunk_store_contract_test.cpp.
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
#include "terrane/store/world_identity.h"
#include "terrane/world/chunk.h"
#include "terrane/world/coords.h"

namespace terrane::store {

enum class Provenance : std::uint8_t {
    Generated,  // the generator makes the same again
    Edited,
};

struct LoadedChunk {
    enum class State : std::uint8_t {
        Absent,   // never saved: to be generated
        Present,  // `chunk` is it
        Damaged,  // `problem` says why. What the save had is kept aside: to be generated.
    };
    State state = State::Absent;
    std::shared_ptr<world::Chunk> chunk;  // the caller's alone, to change as it likes
    Provenance provenance = Provenance::Generated;
    std::string problem;
    // Of a damaged one: it may be whole, but could not be read now. What the save had stays where it is.
    bool isUnread = false;
    bool isOverBudget = false;  // and why: SaveLimits::entityBytes
};

// "chunk 5,-6", of higher levels "chunk 5,-6 of level 2".
std::string nameOf(world::ChunkPos pos);

// Of `positions`, those of which nothing is stored, or what is stored is damaged: to be generated. `stored`:
// what loadMany() gave of them. One over the budget of memory counts as damaged, and stays as it is. Io where
// one could not be read for another reason: it may be there, and a generated one would not be saved.
[[nodiscard]] base::Result<std::vector<world::ChunkPos>> missingOf(std::span<const world::ChunkPos> positions,
                                                                   std::span<const LoadedChunk> stored);

// A world to be read.
class ReadableStore {
  public:
    virtual ~ReadableStore() = default;

    // Blocks for about 50 µs, over a network for milliseconds: read and decoded on the calling thread. Sees
    // what was saved before, durable or not.
    virtual LoadedChunk load(world::ChunkPos pos) = 0;
    // As load() of each, in the order of `positions`. A job loads its chunks by one call: a store answers all
    // of them in one transaction, or one round trip over a network.
    virtual std::vector<LoadedChunk> loadMany(std::span<const world::ChunkPos> positions);
    virtual bool contains(world::ChunkPos pos) = 0;  // as load() tells, without reading the chunk
    // The edited chunks of level 0, in the order of x and y, without those that wait to be saved. Looks at
    // every row of a file.
    [[nodiscard]] virtual base::Result<std::vector<world::ChunkPos>> editedChunks() = 0;

    // Small texts by name, for example the player's position.
    virtual std::optional<std::string> metadata(std::string_view name) = 0;
    virtual const WorldIdentity& identity() const = 0;
};

// Saves are numbered from 1 in the order of the calls.
using SaveNumber = std::uint64_t;

struct SaveStatus {
    SaveNumber queued = 0;      // the last one asked for
    SaveNumber durable = 0;     // it and all before it survive the end of the program, and of the power
    std::size_t waiting = 0;    // chunks not durable yet
    std::string problem;        // why the last attempt to write failed; empty after one that did not
    double failingSeconds = 0;  // since the first attempt that failed
};

// The destructor writes what waits.
class ChunkStore : public ReadableStore {
  public:
    // Takes the snapshot and returns at once; a newer one of the same position replaces an older one that
    // waits. A generated chunk never replaces an edited one.
    virtual SaveNumber save(world::ChunkPos pos, world::ChunkPtr chunk, Provenance provenance) = 0;

    // Saved in the same order as chunks. What identity() is read from (seed, generator, generator_version)
    // and kDerivedRowsMark cannot be set: that is logged as an error, and nothing changes.
    virtual SaveNumber setMetadata(std::string_view name, std::string value) = 0;

    // Blocks until all saves so far are durable, or one attempt to write them has failed.
    [[nodiscard]] virtual base::Result<void> flush() = 0;
    virtual SaveStatus status() = 0;

    // From now on these rows are written with the edited chunks that they follow from, in one transaction.
    // Empty functions: none. Returns when no function given before runs any more.
    virtual void setDerivedRows(DerivedRows rows) = 0;
    // Deletes all rows of levels above 0 and derives them again from all edited chunks, in one transaction,
    // on the calling thread; written() is not called. Saves wait meanwhile. What `rules` names becomes the
    // value of kDerivedRowsMark. setDerivedRows() comes first.
    [[nodiscard]] virtual base::Result<void> deriveAll(std::string_view rules) = 0;

    // For a world that several servers write: what is saved from now on has all edits of their history up to
    // this one, and an older snapshot that comes late never replaces a newer one. Others ignore it.
    virtual void setVersion(std::int64_t /*newestEdit*/) {}

    virtual bool isPersistent() const = 0;  // false: all is lost when the program ends
};

}  // namespace terrane::store
