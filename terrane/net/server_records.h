// What a server keeps beside its world: who plays there, claims, small texts, and the history of edits.
// SqliteRecords keeps it in a file beside the world's.
//
// Writes are collected and made durable together, on a thread of the records, about as soon as the disk can:
// a command is acknowledged when it is durable. Functions are for one thread, the server's, but where said
// otherwise.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "terrane/game/permissions.h"
#include "terrane/net/edit_log.h"
#include "terrane/net/keys.h"
#include "terrane/world/pose.h"

namespace terrane::net {

struct KnownPlayer {
    game::PlayerId id = game::kNoPlayer;
    PublicKey key{};
    std::string name;
    game::Role role = game::Role::Player;
    std::optional<world::Pose> pose;  // where it left
    std::string ban;                  // the reason; empty: none
};

// What is new of a player; what is not given stays.
struct PlayerChange {
    std::optional<std::string> name = {};
    std::optional<game::Role> role = {};
    std::optional<world::Pose> pose = {};
    std::optional<std::string> ban = {};
};

struct HistoryEnds {
    std::int64_t newest = 0;  // number of the newest edit that is durable; 0: none
    std::int64_t saved = 0;   // all edits up to this one are in the world's own store
};

// In texts: the hash of the password; empty: none is needed.
inline constexpr const char* kPasswordText = "password";

class SharedWorld;  // shared_world.h

class ServerRecords {
  public:
    virtual ~ServerRecords() = default;  // writes what waits

    // Read from what is durable; these wait. Rows that make no sense are an error.
    [[nodiscard]] virtual base::Result<std::vector<KnownPlayer>> players() = 0;
    [[nodiscard]] virtual base::Result<std::vector<game::Claim>> claims() = 0;
    // Empty where there is none.
    [[nodiscard]] virtual base::Result<std::string> text(const std::string& name) = 0;
    [[nodiscard]] virtual base::Result<HistoryEnds> historyEnds() = 0;
    [[nodiscard]] virtual base::Result<void> forEachEdit(const EditFilter& filter, EditOrder order,
                                                         const UseEdit& use) = 0;

    // Each returns at once. Writes have numbers in ascending order, and are made in this order.
    virtual void addPlayer(const KnownPlayer& player) = 0;
    virtual void changePlayer(game::PlayerId id, const PlayerChange& change) = 0;
    virtual void addClaim(const game::Claim& claim) = 0;
    virtual void removeClaim(const std::string& name) = 0;
    virtual void setText(const std::string& name, const std::string& text) = 0;
    // What one command changed; gives the number of the write.
    virtual std::uint64_t append(const std::vector<LoggedEdit>& edits) = 0;
    virtual void setSavedEdit(std::int64_t number) = 0;

    // All writes up to this number survive the end of the program, and of the power. Any thread.
    virtual std::uint64_t durable() const = 0;
    // Why the last attempt to write failed; empty after one that did not. Any thread.
    virtual std::string problem() const = 0;
    // Blocks until all writes so far are durable, or one attempt has failed.
    [[nodiscard]] virtual base::Result<void> flush() = 0;

    // Null where one server has the records for itself.
    virtual SharedWorld* shared() { return nullptr; }
};

}  // namespace terrane::net
