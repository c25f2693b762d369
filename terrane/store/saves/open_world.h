// Opens the world at a location that is a name or a file. Programs call store_postgres/any_world.h, which
// also opens worlds in databases. Any thread, usually the one that starts a session.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "terrane/store/chunk_store.h"
#include "terrane/store/save_queue.h"
#include "terrane/store/saves/save_path.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::store {

enum class WorldAccess {
    // The world must exist and is not changed: changes are stored in memory. Another program may use it.
    ReadOnly,
    ReadWrite,  // fails if the world cannot be written
};

// Which other programs may write the world meanwhile. A file always has a single writing program.
enum class WorldSharing {
    Alone,
    Servers,    // other servers of the same world
    Generating  // any program: only chunks without edits are written
};

struct WorldRequest {
    WorldAccess access = WorldAccess::ReadWrite;
    // The identity of a new world, created with its folders if none exists. Without a value the world must
    // exist.
    std::optional<WorldIdentity> create;
    // Requirements for an existing world (compareWorld()). A world is copied before it is regenerated, except
    // for followsGenerator.
    RequestedWorld world;
    GeneratorVersionOf versionOf;  // versions of the program's generators
    WorldSharing sharing = WorldSharing::Alone;
    SaveLimits limits;
};

// Opens or creates the world. Errors are NotFound if there is no world, Busy if another program has it and it
// is to be written, Incompatible if it is another world or not a world, Damaged, Unsupported for a URL.
[[nodiscard]] base::Result<std::unique_ptr<ChunkStore>> openWorld(const WorldLocation& location,
                                                                  const world::BlockRegistry& blocks,
                                                                  const WorldRequest& request);

// Fails for an unfinished copy (world_copy.h).
[[nodiscard]] base::Result<void> requireWhole(ReadableStore& world, const std::string& where);

// Opens the world of `saved` with changes in memory. `where`: for messages. Errors as above.
[[nodiscard]] base::Result<std::unique_ptr<ChunkStore>> openOverlay(std::unique_ptr<ReadableStore> saved,
                                                                    const WorldRequest& request,
                                                                    const std::string& where);

}  // namespace terrane::store
