// A server's records beside its world: players, claims, small texts, and the edit history. SqliteRecords
// stores them in a file beside the world's.
//
// Writes are collected and committed together by a thread of the records, about as fast as the disk allows: a
// command is acknowledged when it is durable. Functions are for the server's thread unless stated otherwise.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/game/permissions.h"
#include "terrane/net/server/edit_log.h"
#include "terrane/net/wire/security.h"
#include "terrane/store/saves/server_file.h"
#include "terrane/store/sqlite/sqlite.h"
#include "terrane/world/pose.h"

namespace terrane::net {

struct KnownPlayer {
    game::PlayerId id = game::kNoPlayer;
    PublicKey key{};
    std::string name;
    game::Role role = game::Role::Player;
    std::optional<world::Pose> pose;  // at the last logout
    std::string ban;                  // the reason; empty: not banned
};

// Changes of a player; fields without a value stay.
struct PlayerChange {
    std::optional<std::string> name = {};
    std::optional<game::Role> role = {};
    std::optional<world::Pose> pose = {};
    std::optional<std::string> ban = {};
};

using store::HistoryEnds;

// Name of the text with the hash of the server's password; empty: no password.
inline constexpr const char* kPasswordText = "password";
// Name of the text with seed and generator of the world; empty before a server opened it.
inline constexpr const char* kWorldText = "world";

// Name of the text with a player's items (game::textOf()); empty: none.
inline std::string itemsTextOf(game::PlayerId player) {
    return "items." + std::to_string(player);
}

class SharedWorld;  // shared_world.h

// Read access to the durable state. Functions block; invalid rows are an error.
class ReadableRecords {
  public:
    virtual ~ReadableRecords() = default;

    [[nodiscard]] virtual base::Result<std::vector<KnownPlayer>> players() = 0;
    [[nodiscard]] virtual base::Result<std::vector<game::Claim>> claims() = 0;
    // Empty if there is no such text.
    [[nodiscard]] virtual base::Result<std::string> text(const std::string& name) = 0;
    [[nodiscard]] virtual base::Result<HistoryEnds> historyEnds() = 0;
    [[nodiscard]] virtual base::Result<void> forEachEdit(const EditFilter& filter, EditOrder order,
                                                         const UseEdit& use) = 0;
};

// The destructor commits queued writes.
class ServerRecords : public ReadableRecords {
  public:
    // These queue a write and do not block. Writes have ascending numbers and run in this order.
    virtual void addPlayer(const KnownPlayer& player) = 0;
    virtual void changePlayer(game::PlayerId id, const PlayerChange& change) = 0;
    virtual void addClaim(const game::Claim& claim) = 0;
    virtual void removeClaim(const std::string& name) = 0;
    virtual void setText(const std::string& name, const std::string& text) = 0;
    // Appends the edits of one command; returns the number of the write.
    virtual std::uint64_t append(const std::vector<LoggedEdit>& edits) = 0;
    virtual void setSavedEdit(std::int64_t number) = 0;
    // Until the result is released, no queued write begins: the writes of this time are one transaction. Not
    // to be held for long, and flush() not to be called meanwhile. Null if the records are shared.
    [[nodiscard]] virtual std::shared_ptr<void> together() { return nullptr; }

    // All writes up to this number survive the end of the program and a power failure. Any thread.
    virtual std::uint64_t durable() const = 0;
    // Why the last attempt to write failed; empty if it succeeded. Any thread.
    virtual std::string problem() const = 0;
    // Blocks until all queued writes are durable, or an attempt failed.
    [[nodiscard]] virtual base::Result<void> flush() = 0;

    // Null if the records are not shared between servers.
    virtual SharedWorld* shared() { return nullptr; }

    // Begins a copy of all records as of now, with all queued writes and none of the later ones, without
    // blocking. For records in a file, which are not shared.
    virtual store::WriteCopy copyFromNow() { return {}; }
};

// Table rows of players and claims, and their conversion. Plain values and functions, for the records of
// servers.
struct PlayerRow {
    std::int64_t id = 0;
    ByteView key;
    std::string_view name;
    std::int64_t role = 0;
    std::string_view pose, ban;  // empty: none
};
// No value if the row is invalid.
std::optional<KnownPlayer> knownPlayer(const PlayerRow& row);

struct ClaimRow {
    std::string_view name;
    std::array<std::int64_t, 4> area{};  // x0, y0, x1, y1
    std::int64_t owner = 0;
    std::string_view members;
};
std::optional<game::Claim> claimOf(const ClaimRow& row);

// Ids separated by spaces: "3 7 12".
std::string membersText(const std::vector<game::PlayerId>& members);

// First id of a server's player; kNoPlayer and kLocalPlayer are reserved.
constexpr game::PlayerId kFirstPlayer = game::kLocalPlayer + 1;

// Reads all records; fails if a server could not.
[[nodiscard]] base::Result<void> checkRecords(ReadableRecords& records);

// Copies a server's records, keeping the numbers of players and edits, into records that are empty or hold
// the beginning of the same history. Blocks until all is durable.
struct RecordsCopied {
    std::size_t players = 0, claims = 0;
    std::int64_t edits = 0;
};

// Whether the copied world may lack edits at the end of the history, which only a server can add.
enum class WorldOfCopy : std::uint8_t { HasAllEdits, MayLackEdits };
// Fails if the world's store lacks edits although it must have all, and with ErrorCode::Incompatible if `to`
// has a different history.
[[nodiscard]] base::Result<RecordsCopied> copyRecords(ReadableRecords& from, ServerRecords& to,
                                                      WorldOfCopy world = WorldOfCopy::HasAllEdits);

}  // namespace terrane::net
