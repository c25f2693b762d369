// Table rows of players and claims, and their conversion. Plain values and functions, for the records of
// servers.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/net/server_records.h"

namespace terrane::net {

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

}  // namespace terrane::net
