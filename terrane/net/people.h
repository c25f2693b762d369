// Everybody who ever played on a server, with what it keeps of them, and the claims: in memory, and written
// to the server's records as it changes. On the server's thread.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "terrane/game/permissions.h"
#include "terrane/net/message_types.h"
#include "terrane/net/server_records.h"

namespace terrane::net {

// A name has 1 to kMaxNameBytes bytes of plain text (wire.h) without spaces at its ends. Lines of the console
// name everybody: it has no quotation mark, and "*", who is anybody there, is none.
bool isName(std::string_view name);
std::string nameRule();  // as a sentence

class People {
  public:
    // All of the records, which it keeps.
    [[nodiscard]] static base::Result<People> read(ServerRecords& records);

    // Null where nobody has it. Names are compared without case, as far as letters of ASCII go. Pointers
    // hold.
    const KnownPlayer* byId(game::PlayerId id) const;
    const KnownPlayer* byKey(const PublicKey& key) const;
    const KnownPlayer* byName(std::string_view name) const;

    // `key` and `name` are new here. Without a number it is the next one.
    const KnownPlayer& add(const PublicKey& key, const std::string& name, game::Role role,
                           game::PlayerId number = game::kNoPlayer);
    // What another server wrote: nothing is written here.
    void learn(const KnownPlayer& player);
    void learnClaims(const std::vector<game::Claim>& claims);
    void forget(game::PlayerId id);
    // Of somebody who is known.
    void setName(game::PlayerId id, const std::string& name);
    void setRole(game::PlayerId id, game::Role role);
    void setPose(game::PlayerId id, const world::Pose& pose);
    void setBan(game::PlayerId id, const std::string& reason);

    const game::Claims& claims() const { return claims_; }
    [[nodiscard]] base::Result<void> addClaim(const game::Claim& claim);
    bool removeClaim(std::string_view name);

  private:
    explicit People(ServerRecords& records) : records_(&records) {}

    ServerRecords* records_;
    std::map<game::PlayerId, KnownPlayer> players_;
    game::Claims claims_;
};

}  // namespace terrane::net
