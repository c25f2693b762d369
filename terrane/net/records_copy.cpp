#include "terrane/net/records_copy.h"

#include <algorithm>

#include "terrane/net/shared_world.h"

namespace terrane::net {
namespace {

// Edits queued before each flush.
constexpr std::size_t kEditsAtOnce = 2000;

base::Result<void> copyEdits(ServerRecords& from, ServerRecords& to, std::int64_t after) {
    std::size_t waiting = 0;
    const auto take = [&](const LoggedEdit& edit) -> base::Result<void> {
        to.append({edit});
        if (++waiting % kEditsAtOnce != 0) return {};
        if (SharedWorld* shared = to.shared()) (void)shared->takeNews();  // else it would keep all edits
        return to.flush();
    };
    const EditFilter rest{.afterNumber = after};
    if (auto copied = from.forEachEdit(rest, EditOrder::OldestFirst, take); !copied) return copied;
    return to.flush();
}

}  // namespace

base::Result<RecordsCopied> copyRecords(ServerRecords& from, ServerRecords& to) {
    const auto ends = from.historyEnds(), begun = to.historyEnds();
    if (!ends || !begun) return tl::unexpected((!ends ? ends : begun).error());
    if (ends->saved < ends->newest)
        return base::fail(base::ErrorCode::Incompatible,
                          "its chunks lack {} edits of its history: stop its server, or start and stop it "
                          "where it was killed, "
                          "before it is copied",
                          ends->newest - ends->saved);
    if (begun->newest > ends->newest)
        return base::fail(base::ErrorCode::Incompatible,
                          "the copy has a history of its own: {} edits, expected {}", begun->newest,
                          ends->newest);
    const auto players = from.players();
    if (!players) return tl::unexpected(players.error());
    const auto known = to.players();
    if (!known) return tl::unexpected(known.error());
    // A resumed copy may have outdated players and claims.
    for (const KnownPlayer& player : *players) {
        if (std::ranges::none_of(*known, [&](const KnownPlayer& other) { return other.id == player.id; }))
            to.addPlayer(player);
        else
            to.changePlayer(
                player.id,
                {.name = player.name, .role = player.role, .pose = player.pose, .ban = player.ban});
    }
    const auto claims = from.claims();
    if (!claims) return tl::unexpected(claims.error());
    const auto former = to.claims();
    if (!former) return tl::unexpected(former.error());
    for (const game::Claim& claim : *former) to.removeClaim(claim.name);
    for (const game::Claim& claim : *claims) to.addClaim(claim);
    const auto password = from.text(kPasswordText);
    if (!password) return tl::unexpected(password.error());
    to.setText(kPasswordText, *password);
    if (auto copied = copyEdits(from, to, begun->newest); !copied) return tl::unexpected(copied.error());
    to.setSavedEdit(ends->newest);
    if (auto flushed = to.flush(); !flushed) return tl::unexpected(flushed.error());
    const auto end = to.historyEnds();
    if (!end) return tl::unexpected(end.error());
    if (end->newest != ends->newest)
        return base::fail(base::ErrorCode::Incompatible, "the copy's history ends with edit {}, expected {}",
                          end->newest, ends->newest);
    if (to.shared()) to.shared()->tellState(0, ends->newest);
    return RecordsCopied{players->size(), claims->size(), ends->newest};
}

}  // namespace terrane::net
