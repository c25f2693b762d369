#include "terrane/store_postgres/world_locks.h"

#include <xxhash.h>

#include <chrono>
#include <thread>

namespace terrane::store_postgres {
namespace {

using base::ErrorCode;
using store::WorldSharing;

constexpr const char* kWaitForOpening = "20s";
// The server notices the end of a program or a lost connection with a delay.
constexpr std::chrono::milliseconds kWaitForEnd{500}, kLookAgain{20};

constexpr Statement kLock = {"SELECT pg_advisory_lock($1, $2)"};
constexpr Statement kTryLock = {"SELECT pg_try_advisory_lock($1, $2)"};
constexpr Statement kTryLockShared = {"SELECT pg_try_advisory_lock_shared($1, $2)"};
constexpr Statement kUnlock = {"SELECT pg_advisory_unlock($1, $2)"};
constexpr Statement kLockTransaction = {"SELECT pg_advisory_xact_lock($1, $2)"};
constexpr Statement kHolder = {
    "SELECT pid, coalesce(host(client_addr), 'the machine of the database') FROM pg_locks "
    "JOIN pg_stat_activity USING (pid) WHERE locktype = 'advisory' AND granted AND pid <> pg_backend_pid() "
    "AND database = (SELECT oid FROM pg_database WHERE datname = current_database()) "
    "AND classid = ($1::bigint & 4294967295)::oid AND objid = ($2::bigint)::oid LIMIT 1"};

// Advisory locks have two numbers: the first one identifies the world.
std::int32_t numberOf(const Address& address) {
    return static_cast<std::int32_t>(XXH32(address.schema.data(), address.schema.size(), 0));
}

Parameters lockParameters(const Address& address, WorldLock lock) {
    return Parameters().integer(numberOf(address)).integer(static_cast<std::int32_t>(lock));
}

// For messages: the program that holds the lock. PostgreSQL may hide the address of other users.
std::string holderOf(Connection& connection, const Address& address, WorldLock lock) {
    const auto rows = connection.run(
        kHolder, Parameters().number(numberOf(address)).number(static_cast<std::int64_t>(lock)));
    if (!rows || rows->count() == 0) return "another program";
    return fmt::format("another program (process {} of the server, from {})", rows->number(0, 0),
                       rows->text(0, 1));
}

base::Result<void> tryLock(Connection& connection, const Address& address, WorldLock lock,
                           const Statement& how) {
    const auto taken = TERRANE_TRY(connection.run(how, lockParameters(address, lock)));
    if (taken.number(0, 0) != 0) return {};
    return base::fail(ErrorCode::Busy, "{}: open in {}", address.shown, holderOf(connection, address, lock));
}

base::Result<void> tryLockForAMoment(Connection& connection, const Address& address, WorldLock lock,
                                     const Statement& how) {
    const auto end = std::chrono::steady_clock::now() + kWaitForEnd;
    while (true) {
        auto taken = tryLock(connection, address, lock, how);
        const bool isBusy = !taken && taken.error().code == ErrorCode::Busy;
        if (!isBusy || std::chrono::steady_clock::now() >= end) return taken;
        std::this_thread::sleep_for(kLookAgain);
    }
}

}  // namespace

base::Result<void> takeSharedLocks(Connection& connection, const Address& address, WorldSharing sharing) {
    auto taken = tryLockForAMoment(connection, address, WorldLock::Identity, kTryLockShared);
    if (!taken || sharing == WorldSharing::Generating) return taken;
    return tryLockForAMoment(connection, address, WorldLock::Edits,
                             sharing == WorldSharing::Alone ? kTryLock : kTryLockShared);
}

void releaseAllLocks(Connection& connection) {
    if (connection.isUsable()) (void)connection.execute("SELECT pg_advisory_unlock_all()");
}

// Serializes the openings of a world.
base::Result<void> waitForOpening(Connection& connection, const Address& address) {
    const std::string shortly = fmt::format("SET lock_timeout = '{}'", kWaitForOpening);
    TERRANE_TRY(connection.execute(shortly));
    const auto taken = connection.run(kLock, lockParameters(address, WorldLock::Opening));
    if (!taken && taken.error().code == ErrorCode::Busy)
        return base::fail(ErrorCode::Busy, "{}: being opened in {}", address.shown,
                          holderOf(connection, address, WorldLock::Opening));
    if (!taken) return tl::unexpected(taken.error());
    return connection.execute("SET lock_timeout = 0");
}

base::Result<void> takeLock(Connection& connection, const Address& address, WorldLock lock) {
    return tryLockForAMoment(connection, address, lock, kTryLock);
}

base::Result<void> releaseLock(Connection& connection, const Address& address, WorldLock lock) {
    return connection.change(kUnlock, lockParameters(address, lock));
}

base::Result<void> lockForTransaction(Connection& connection, const Address& address, WorldLock lock) {
    return connection.change(kLockTransaction, lockParameters(address, lock));
}

}  // namespace terrane::store_postgres
