// Opens the world at a location that is a name or a file. store_postgres/any_world.h opens those in
// databases as well: programs call that. Any thread, usually the one that starts a session.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "terrane/store/chunk_store.h"
#include "terrane/store/save_queue.h"
#include "terrane/store/world_location.h"
#include "terrane/world/block_registry.h"

namespace terrane::store {

enum class WorldAccess {
    // The world must be there, and stays as it is: changes are kept in memory. Another program may play it.
    ReadOnly,
    ReadWrite,  // an error where the world cannot be written
};

// Who else may write the world meanwhile. A file has one program that writes, whatever is asked for.
enum class WorldSharing {
    Alone,
    Servers,    // others that serve the same world
    Generating  // anybody: only chunks without edits are written
};

struct WorldRequest {
    WorldAccess access = WorldAccess::ReadWrite;
    // What a world is made with, and its folders, where none is there. Nothing: it must be there.
    std::optional<WorldIdentity> create;
    // What a world that is there must be (compareWorld()). One to be regenerated is copied first.
    WantedWorld wanted;
    GeneratorVersionOf versionOf;  // what the program has
    WorldSharing sharing = WorldSharing::Alone;
    SaveLimits limits;
};

// Errors: NotFound where there is no world, Busy where another program has it and it is to be written,
// Incompatible where it is another world or no world, Damaged, Unsupported for a URL.
[[nodiscard]] base::Result<std::unique_ptr<ChunkStore>> openWorld(const WorldLocation& location,
                                                                  const world::BlockRegistry& blocks,
                                                                  const WorldRequest& request);

// An error for a copy that has not ended (world_copy.h).
[[nodiscard]] base::Result<void> requireWhole(ReadableStore& world, const std::string& where);

// The world that `saved` holds, with changes in memory. `where` is for messages. Errors as above.
[[nodiscard]] base::Result<std::unique_ptr<ChunkStore>> openOver(std::unique_ptr<ReadableStore> saved,
                                                                 const WorldRequest& request,
                                                                 const std::string& where);

}  // namespace terrane::store
