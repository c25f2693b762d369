// Permissions in a world that several people share: roles, and claims, which are areas with an owner. Session
// calls refusal() or mayChangeAll() for the blocks of each player's command. All are plain values.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/game/edit_command.h"

namespace terrane::game {

enum class Role : std::uint8_t {
    Guest,     // looks and talks
    Player,    // builds, but in nobody else's claim
    Operator,  // builds everywhere
    Count
};

// The columns from corner to corner, both included; low ≤ high in each coordinate.
struct ColumnArea {
    std::int32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    bool contains(world::BlockPos pos) const {
        return pos.x >= x0 && pos.x <= x1 && pos.y >= y0 && pos.y <= y1;
    }
    bool overlaps(const ColumnArea& other) const {
        return x0 <= other.x1 && other.x0 <= x1 && y0 <= other.y1 && other.y0 <= y1;
    }
    bool operator==(const ColumnArea&) const = default;
};

struct Claim {
    std::string name;  // unique
    ColumnArea area;
    PlayerId owner = kNoPlayer;
    std::vector<PlayerId> members;  // others who may build there
};

// Claims do not overlap: a block has at most one owner. They are searched linearly, since a server has some
// hundreds.
class Claims {
  public:
    // Adds a claim. Returns an error if the name is in use, or if the area overlaps another claim, which the
    // message names.
    [[nodiscard]] base::Result<void> add(Claim claim);
    bool remove(std::string_view name);  // false: there is none

    const Claim* find(std::string_view name) const;  // null: none
    const Claim* at(world::BlockPos pos) const;      // null: nobody's
    const std::vector<Claim>& all() const { return claims_; }

  private:
    std::vector<Claim> claims_;
};

struct Permissions {
    std::unordered_map<PlayerId, Role> roles;
    Role otherwise = Role::Player;  // of those without a role of their own
    Claims claims;

    Role roleOf(PlayerId player) const;
};

// Returns the reason why a player may not change a block: NotAllowed or Claimed; nothing if it may.
// kNoPlayer, the world itself, may change all.
std::optional<EditResult> refusal(const Permissions& permissions, PlayerId player, world::BlockPos pos);
// Returns whether the player may change all of the blocks, which have a member `pos`. The blocks are not
// visited if there is no claim.
bool mayChangeAll(const Permissions& permissions, PlayerId player, const auto& blocks) {
    if (player == kNoPlayer || permissions.roleOf(player) == Role::Operator) return true;
    if (permissions.claims.all().empty() && permissions.roleOf(player) != Role::Guest) return true;
    return std::ranges::none_of(
        blocks, [&](const auto& block) { return refusal(permissions, player, block.pos).has_value(); });
}

}  // namespace terrane::game
