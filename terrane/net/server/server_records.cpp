#include "terrane/net/server/server_records.h"

#include <algorithm>
#include <charconv>

#include "terrane/game/player_state.h"
#include "terrane/net/server/place_owners.h"
#include "terrane/net/sharing/shared_world.h"

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
    player.pose = game::parsePose(std::string(row.pose));
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

namespace {

// Edits queued before each flush.
constexpr std::size_t kEditsAtOnce = 2000;

base::Result<void> copyEdits(ReadableRecords& from, ServerRecords& to, std::int64_t after) {
    std::size_t waiting = 0;
    const auto take = [&](const LoggedEdit& edit) -> base::Result<void> {
        to.append({edit});
        if (++waiting % kEditsAtOnce != 0) return {};
        if (SharedWorld* shared = to.shared()) (void)shared->popChanges();  // else it would keep all edits
        return to.flush();
    };
    const EditFilter rest{.afterNumber = after};
    TERRANE_TRY(from.forEachEdit(rest, EditOrder::OldestFirst, take));
    return to.flush();
}

}  // namespace

base::Result<void> checkRecords(ReadableRecords& records) {
    (void)TERRANE_TRY(records.players());
    (void)TERRANE_TRY(records.claims());
    (void)TERRANE_TRY(records.text(kPasswordText));
    return records.forEachEdit({}, EditOrder::OldestFirst,
                               [](const LoggedEdit&) { return base::Result<void>(); });
}

base::Result<RecordsCopied> copyRecords(ReadableRecords& from, ServerRecords& to, WorldOfCopy world) {
    const auto ends = from.historyEnds(), begun = to.historyEnds();
    if (!ends || !begun) return tl::unexpected((!ends ? ends : begun).error());
    if (world == WorldOfCopy::HasAllEdits && ends->saved < ends->newest)
        return base::fail(base::ErrorCode::Incompatible,
                          "its chunks lack {} edits of its history: stop its server, or start and stop it "
                          "where it was killed, "
                          "before it is copied",
                          ends->newest - ends->saved);
    if (begun->newest > ends->newest)
        return base::fail(base::ErrorCode::Incompatible,
                          "the copy has a history of its own: {} edits, expected {}", begun->newest,
                          ends->newest);
    const auto players = TERRANE_TRY(from.players());
    const auto known = TERRANE_TRY(to.players());
    // A resumed copy may have outdated players and claims.
    for (const KnownPlayer& player : players) {
        if (std::ranges::none_of(known, [&](const KnownPlayer& other) { return other.id == player.id; }))
            to.addPlayer(player);
        else
            to.changePlayer(
                player.id,
                {.name = player.name, .role = player.role, .pose = player.pose, .ban = player.ban});
    }
    const auto claims = TERRANE_TRY(from.claims());
    const auto former = TERRANE_TRY(to.claims());
    for (const game::Claim& claim : former) to.removeClaim(claim.name);
    for (const game::Claim& claim : claims) to.addClaim(claim);
    const auto password = TERRANE_TRY(from.text(kPasswordText));
    to.setText(kPasswordText, password);
    for (const KnownPlayer& player : players) {
        const std::string name = placesTextOf(player.id);
        const auto places = TERRANE_TRY(from.text(name));
        if (!places.empty()) to.setText(name, places);
        const auto items = TERRANE_TRY(from.text(itemsTextOf(player.id)));
        if (!items.empty()) to.setText(itemsTextOf(player.id), items);
    }
    TERRANE_TRY(copyEdits(from, to, begun->newest));
    to.setSavedEdit(ends->saved);
    TERRANE_TRY(to.flush());
    const auto end = TERRANE_TRY(to.historyEnds());
    if (end.newest != ends->newest)
        return base::fail(base::ErrorCode::Incompatible, "the copy's history ends with edit {}, expected {}",
                          end.newest, ends->newest);
    if (to.shared()) to.shared()->publishState(0, ends->saved);
    return RecordsCopied{players.size(), claims.size(), ends->newest};
}

}  // namespace terrane::net
