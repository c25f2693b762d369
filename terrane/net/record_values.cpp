#include "terrane/net/record_values.h"

#include <algorithm>
#include <charconv>

#include "terrane/game/pose_text.h"

namespace terrane::net {
namespace {

// No value if a word is not a number.
std::optional<std::vector<game::PlayerId>> membersFrom(std::string_view text) {
    std::vector<game::PlayerId> members;
    while (!text.empty()) {
        game::PlayerId member = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), member);
        if (error != std::errc()) return std::nullopt;
        members.push_back(member);
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        if (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    }
    return members;
}

}  // namespace

std::string membersText(const std::vector<game::PlayerId>& members) {
    std::string text;
    for (const game::PlayerId member : members) text += fmt::format("{}{}", text.empty() ? "" : " ", member);
    return text;
}

std::optional<KnownPlayer> knownPlayer(const PlayerRow& row) {
    KnownPlayer player;
    if (row.key.size() != player.key.size() || row.id < kFirstPlayer || row.id > 0xFFFFFFFF)
        return std::nullopt;
    if (row.role < 0 || row.role >= static_cast<std::int64_t>(game::Role::Count)) return std::nullopt;
    std::ranges::copy(row.key, player.key.begin());
    player.id = static_cast<game::PlayerId>(row.id);
    player.name = row.name;
    player.role = static_cast<game::Role>(row.role);
    player.pose = game::poseFrom(std::string(row.pose));
    player.ban = row.ban;
    return player;
}

std::optional<game::Claim> claimOf(const ClaimRow& row) {
    auto members = membersFrom(row.members);
    if (!members) return std::nullopt;
    const auto at = [&](std::size_t k) { return static_cast<std::int32_t>(row.area[k]); };
    return game::Claim{std::string(row.name),
                       {at(0), at(1), at(2), at(3)},
                       static_cast<game::PlayerId>(row.owner),
                       std::move(*members)};
}

}  // namespace terrane::net
