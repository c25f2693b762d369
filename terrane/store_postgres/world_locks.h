// The locks under which programs share a world in PostgreSQL: advisory locks, released with the connection
// that took them.
#pragma once

#include <cstdint>

#include "terrane/store/saves/open_world.h"
#include "terrane/store_postgres/connection.h"

namespace terrane::store_postgres {

enum class WorldLock : std::int32_t {
    Opening = 1,  // held while a program opens the world for writing
    Identity,     // shared by writers; exclusive to change generator version or block names
    Edits,        // exclusive for a single program; shared by servers
    Tiles,        // for a transaction that derives tiles
    History,      // for a transaction that appends edits
};

// Waits up to 20 s for the turn to open a world, then returns Busy.
[[nodiscard]] base::Result<void> waitForOpening(Connection& connection, const Address& address);

// Takes the locks of a writing program. Busy, naming the program that holds them otherwise.
[[nodiscard]] base::Result<void> takeSharedLocks(Connection& connection, const Address& address,
                                                 store::WorldSharing sharing);

// Call before closing a connection: the server releases locks only a moment later, so the next program to
// open the world would find them held.
void releaseAllLocks(Connection& connection);

// Takes an exclusive lock. Busy if another connection has it, exclusive or shared.
[[nodiscard]] base::Result<void> takeLock(Connection& connection, const Address& address, WorldLock lock);
[[nodiscard]] base::Result<void> releaseLock(Connection& connection, const Address& address, WorldLock lock);
// Waits for the lock and holds it until the transaction ends.
[[nodiscard]] base::Result<void> lockForTransaction(Connection& connection, const Address& address,
                                                    WorldLock lock);

// Runs `action`, which must not happen while others have the world open.
template <class Do>
base::Result<void> doAlone(Connection& connection, const Address& address, Do action) {
    TERRANE_TRY(takeLock(connection, address, WorldLock::Identity));
    base::Result<void> done = action();
    if (connection.isUsable()) (void)releaseLock(connection, address, WorldLock::Identity);
    return done;
}

}  // namespace terrane::store_postgres
