// Where chunks and what belongs to a world are kept between sessions. SqliteStore keeps them in a file,
// MemoryStore until the program ends. Any thread may call everything.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "terrane/base/result.h"
#include "terrane/world/chunk.h"
#include "terrane/world/coords.h"

namespace terrane::store {

// What a world's generated chunks follow from. It never changes during the life of a save.
struct WorldIdentity {
    std::uint64_t seed = 0;
    std::string generator;
    int generatorVersion = 0;

    bool operator==(const WorldIdentity&) const = default;
};

// An error that says in one line how they differ and names `path`, unless they are equal: chunks of two
// generators do not fit together.
[[nodiscard]] base::Result<void> requireSame(const WorldIdentity& saved, const WorldIdentity& wanted,
                                             const std::string& path);

enum class Origin : std::uint8_t {
    Generated,  // the generator makes the same again
    Edited,
};

struct LoadedChunk {
    enum class State : std::uint8_t {
        Absent,   // never saved: to be generated
        Present,  // `chunk` is it
        Damaged,  // `problem` says why and is logged. What the save had is kept aside: to be generated.
    };
    State state = State::Absent;
    world::ChunkPtr chunk;
    Origin origin = Origin::Generated;
    std::string problem;
};

// Saves are numbered from 1 in the order of the calls.
using SaveNumber = std::uint64_t;

struct SaveStatus {
    SaveNumber queued = 0;    // the last one asked for
    SaveNumber durable = 0;   // it and all before it survive the end of the program, and of the power
    std::size_t waiting = 0;  // chunks not durable yet
    std::string problem;      // why the last attempt to write failed; empty after one that did not
};

class ChunkStore {
  public:
    virtual ~ChunkStore() = default;  // writes what waits

    // Blocks for about 50 µs: read and decoded on the calling thread. Sees what was saved before, durable or
    // not.
    virtual LoadedChunk load(world::ChunkPos pos) = 0;
    virtual bool contains(world::ChunkPos pos) = 0;  // as load() tells, without reading the chunk

    // Takes the snapshot and returns at once; a newer one of the same position replaces an older one that
    // waits. A generated chunk never replaces an edited one.
    virtual SaveNumber save(world::ChunkPos pos, world::ChunkPtr chunk, Origin origin) = 0;

    // Small texts by name, for example the player's position. Saved in the same order as chunks. What
    // identity() is read from (seed, generator, generator_version) cannot be set: that is logged as an error,
    // and nothing changes.
    virtual std::optional<std::string> setting(std::string_view name) = 0;
    virtual SaveNumber setSetting(std::string_view name, std::string value) = 0;

    // Blocks until all saves so far are durable, or one attempt to write them has failed.
    [[nodiscard]] virtual base::Result<void> flush() = 0;
    virtual SaveStatus status() = 0;

    virtual const WorldIdentity& identity() const = 0;
    virtual bool isPersistent() const = 0;  // false: all is lost when the program ends
};

}  // namespace terrane::store
