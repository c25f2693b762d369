// All known players of a server and the claims: kept in memory, and written to the server's records when they
// change. On the server's thread.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "terrane/game/permissions.h"
#include "terrane/net/server/server_records.h"
#include "terrane/net/wire/message_codec.h"

namespace terrane::net {

// A name that a Login may hold: 1 to kMaxNameBytes bytes of plain text (wire.h) without leading or trailing
// spaces. It contains no quotation mark, which quotes console arguments, and is not "*", which stands for all
// players there.
bool isName(std::string_view name);
std::string nameRule();  // the rule above, as text for the player
// The normal form of a new name of a player or a claim: one that isName() and base::checkName() accept. The
// error is one line for the player.
[[nodiscard]] base::Result<std::string> newName(std::string_view typed);
// Whether two names are equal, ignoring ASCII case.
bool isSameName(std::string_view a, std::string_view b);

class KnownPlayers {
  public:
    // Reads all players and claims. Keeps a reference to `records`.
    [[nodiscard]] static base::Result<KnownPlayers> read(ServerRecords& records);

    // Null if there is no such player. Names are compared ignoring ASCII case. The pointers stay valid until
    // forget().
    const KnownPlayer* byId(game::PlayerId id) const;
    const KnownPlayer* byKey(const PublicKey& key) const;
    // A name in another normal form is found, too.
    const KnownPlayer* byName(std::string_view name) const;
    // Another player than `id` with a name that looks like this one (base/names.h).
    const KnownPlayer* byLooks(std::string_view name, game::PlayerId id) const;

    // Adds a player. `key` and `name` must be unknown. kNoPlayer as number assigns the next one.
    const KnownPlayer& add(const PublicKey& key, const std::string& name, game::Role role,
                           game::PlayerId number = game::kNoPlayer);
    // Takes over changes made by another server; does not write to the records.
    void learn(const KnownPlayer& player);
    void setClaims(const std::vector<game::Claim>& claims);
    void forget(game::PlayerId id);
    // `id` must be a known player.
    void setName(game::PlayerId id, const std::string& name);
    void setRole(game::PlayerId id, game::Role role);
    void setPose(game::PlayerId id, const world::Pose& pose);
    void setBan(game::PlayerId id, const std::string& reason);
    // The player's items as a text (game::textOf()); empty: none. Reads what is durable.
    [[nodiscard]] base::Result<std::string> items(game::PlayerId id);
    void setItems(game::PlayerId id, const std::string& text);

    const game::Claims& claims() const { return claims_; }
    [[nodiscard]] base::Result<void> addClaim(const game::Claim& claim);
    bool removeClaim(std::string_view name);

  private:
    explicit KnownPlayers(ServerRecords& records) : records_(&records) {}

    KnownPlayer& put(KnownPlayer player);  // added, or in place of the player with its number
    void removeLooks(const KnownPlayer& player);

    ServerRecords* records_;
    std::map<game::PlayerId, KnownPlayer> players_;
    std::unordered_multimap<std::string, game::PlayerId> looks_;  // both texts of base::looksOf()
    game::Claims claims_;
};

}  // namespace terrane::net
