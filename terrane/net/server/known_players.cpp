#include "terrane/net/server/known_players.h"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "terrane/net/server/server_records.h"
#include "terrane/net/wire/wire.h"

namespace terrane::net {

bool isName(std::string_view name) {
    return !name.empty() && name.size() <= kMaxNameBytes && isPlainText(name) && name.front() != ' ' &&
           name.back() != ' ' && name.find('"') == std::string_view::npos && name != "*";
}

std::string nameRule() {
    return fmt::format("a name has 1 to {} bytes, no quotation mark and no spaces at its ends, and is not *",
                       kMaxNameBytes);
}

bool isSameName(std::string_view a, std::string_view b) {
    const auto folded = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    return std::ranges::equal(a, b, {}, folded, folded);
}

base::Result<KnownPlayers> KnownPlayers::read(ServerRecords& records) {
    KnownPlayers knownPlayers(records);
    auto players = TERRANE_TRY(records.players());
    for (KnownPlayer& player : players) knownPlayers.players_.insert({player.id, std::move(player)});
    const auto claims = TERRANE_TRY(records.claims());
    for (const game::Claim& claim : claims)
        if (auto added = knownPlayers.claims_.add(claim); !added)
            return base::fail(base::ErrorCode::Damaged, "the records of the server are damaged: {}",
                              added.error().message);
    return knownPlayers;
}

const KnownPlayer* KnownPlayers::byId(game::PlayerId id) const {
    const auto found = players_.find(id);
    return found == players_.end() ? nullptr : &found->second;
}

const KnownPlayer* KnownPlayers::byKey(const PublicKey& key) const {
    const auto found = std::ranges::find_if(players_, [&](const auto& p) { return p.second.key == key; });
    return found == players_.end() ? nullptr : &found->second;
}

const KnownPlayer* KnownPlayers::byName(std::string_view name) const {
    const auto found =
        std::ranges::find_if(players_, [&](const auto& p) { return isSameName(p.second.name, name); });
    return found == players_.end() ? nullptr : &found->second;
}

const KnownPlayer& KnownPlayers::add(const PublicKey& key, const std::string& name, game::Role role,
                                     game::PlayerId number) {
    assert(!byKey(key) && !byName(name) && "somebody new");
    const game::PlayerId next = players_.empty() ? kFirstPlayer : players_.rbegin()->first + 1;
    const game::PlayerId id = number == game::kNoPlayer ? next : number;
    const KnownPlayer& player = players_.insert({id, {id, key, name, role, {}, {}}}).first->second;
    records_->addPlayer(player);
    return player;
}

void KnownPlayers::learn(const KnownPlayer& player) {
    players_[player.id] = player;
}

void KnownPlayers::setClaims(const std::vector<game::Claim>& claims) {
    claims_ = {};
    for (const game::Claim& claim : claims) (void)claims_.add(claim);  // invalid claims are dropped
}

void KnownPlayers::forget(game::PlayerId id) {
    players_.erase(id);
}

void KnownPlayers::setName(game::PlayerId id, const std::string& name) {
    players_.at(id).name = name;
    records_->changePlayer(id, {.name = name});
}

void KnownPlayers::setRole(game::PlayerId id, game::Role role) {
    players_.at(id).role = role;
    records_->changePlayer(id, {.role = role});
}

void KnownPlayers::setPose(game::PlayerId id, const world::Pose& pose) {
    players_.at(id).pose = pose;
    records_->changePlayer(id, {.pose = pose});
}

void KnownPlayers::setBan(game::PlayerId id, const std::string& reason) {
    players_.at(id).ban = reason;
    records_->changePlayer(id, {.ban = reason});
}

base::Result<void> KnownPlayers::addClaim(const game::Claim& claim) {
    TERRANE_TRY(claims_.add(claim));
    records_->addClaim(claim);
    return {};
}

bool KnownPlayers::removeClaim(std::string_view name) {
    if (!claims_.remove(name)) return false;
    records_->removeClaim(std::string(name));
    return true;
}

}  // namespace terrane::net
