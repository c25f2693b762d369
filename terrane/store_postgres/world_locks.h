// The locks under which several programs share a world in PostgreSQL: advisory locks, which go with the
// connection that took them.
#pragma once

#include <cstdint>

#include "terrane/store/open_world.h"
#include "terrane/store_postgres/connection.h"

namespace terrane::store_postgres {

enum class WorldLock : std::int32_t {
    Opening = 1,  // held while one opens it to write
    Identity,     // shared by all who write; alone who changes the generator's version or names of blocks
    Edits,        // alone: one program plays it; shared by servers
    Tiles,        // for a transaction that derives tiles
    History,      // for a transaction that appends edits
};

// Waits for its turn to open a world, 20 s at most: Busy then.
[[nodiscard]] base::Result<void> waitForOpening(Connection& connection, const Address& address);

// What a program that writes holds. Busy, with the program that holds them otherwise.
[[nodiscard]] base::Result<void> takeSharedLocks(Connection& connection, const Address& address,
                                                 store::WorldSharing sharing);

// Before a connection is closed: the server releases them a moment later, and who opens the world at once
// would meet them.
void releaseAllLocks(Connection& connection);

// Of the connection alone. Busy where another one has it, shared or not.
[[nodiscard]] base::Result<void> takeLock(Connection& connection, const Address& address, WorldLock lock);
[[nodiscard]] base::Result<void> releaseLock(Connection& connection, const Address& address, WorldLock lock);
// Waits for it, and has it until the transaction ends.
[[nodiscard]] base::Result<void> lockForTransaction(Connection& connection, const Address& address,
                                                    WorldLock lock);

// Runs what must not happen while others have the world open.
template <class Do>
base::Result<void> doAlone(Connection& connection, const Address& address, Do action) {
    if (auto taken = takeLock(connection, address, WorldLock::Identity); !taken) return taken;
    base::Result<void> done = action();
    if (connection.isUsable()) (void)releaseLock(connection, address, WorldLock::Identity);
    return done;
}

}  // namespace terrane::store_postgres
