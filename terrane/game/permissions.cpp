#include "terrane/game/permissions.h"

#include <algorithm>
#include <utility>

namespace terrane::game {

base::Result<void> Claims::add(Claim claim) {
    if (claim.area.x0 > claim.area.x1 || claim.area.y0 > claim.area.y1)
        return base::fail(base::ErrorCode::BadInput, "the claim {} has no columns", claim.name);
    for (const Claim& other : claims_) {
        if (other.name == claim.name)
            return base::fail(base::ErrorCode::BadInput, "there is a claim {} already", claim.name);
        if (other.area.overlaps(claim.area))
            return base::fail(base::ErrorCode::BadInput, "the claim {} overlaps the claim {}", claim.name,
                              other.name);
    }
    claims_.push_back(std::move(claim));
    return {};
}

bool Claims::remove(std::string_view name) {
    return std::erase_if(claims_, [&](const Claim& claim) { return claim.name == name; }) > 0;
}

const Claim* Claims::find(std::string_view name) const {
    const auto found = std::ranges::find(claims_, name, &Claim::name);
    return found == claims_.end() ? nullptr : &*found;
}

const Claim* Claims::at(world::BlockPos pos) const {
    const auto found = std::ranges::find_if(claims_, [&](const Claim& c) { return c.area.contains(pos); });
    return found == claims_.end() ? nullptr : &*found;
}

Role Permissions::roleOf(PlayerId player) const {
    const auto found = roles.find(player);
    return found == roles.end() ? otherwise : found->second;
}

std::optional<EditResult> refusal(const Permissions& permissions, PlayerId player, world::BlockPos pos) {
    if (player == kNoPlayer) return std::nullopt;
    const Role role = permissions.roleOf(player);
    if (role == Role::Operator) return std::nullopt;
    if (role == Role::Guest) return EditResult::NotAllowed;
    const Claim* claim = permissions.claims.at(pos);
    if (!claim || claim->owner == player || std::ranges::count(claim->members, player) > 0)
        return std::nullopt;
    return EditResult::Claimed;
}

}  // namespace terrane::game
