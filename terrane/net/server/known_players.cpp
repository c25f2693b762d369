#include "terrane/net/server/known_players.h"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "terrane/base/names.h"
#include "terrane/net/server/server_records.h"
#include "terrane/net/wire/wire.h"

namespace terrane::net {

namespace {

constexpr std::string_view kServerName = "server";

}  // namespace

bool isName(std::string_view name) {
    return !name.empty() && name.size() <= kMaxNameBytes && isPlainText(name) && name.front() != ' ' &&
           name.back() != ' ' && name.find('"') == std::string_view::npos && name != "*";
}

std::string nameRule() {
    return fmt::format("a name has 1 to {} bytes, no quotation mark and no spaces at its ends, and is not *",
                       kMaxNameBytes);
}

base::Result<std::string> newName(std::string_view typed) {
    auto name = TERRANE_TRY(base::checkName(typed, kMaxNameBytes));
    if (!isName(name)) return base::fail(base::ErrorCode::BadInput, "{}", nameRule());
    if (base::isConfusable(name, kServerName))
        return base::fail(base::ErrorCode::BadInput, "the name {} looks like the server's own", name);
    return name;
}

bool isSameName(std::string_view a, std::string_view b) {
    const auto folded = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    return std::ranges::equal(a, b, {}, folded, folded);
}

base::Result<KnownPlayers> KnownPlayers::read(ServerRecords& records) {
    KnownPlayers knownPlayers(records);
    auto players = TERRANE_TRY(records.players());
    for (KnownPlayer& player : players) knownPlayers.put(std::move(player));
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
    const auto find = [&](std::string_view wanted) -> const KnownPlayer* {
        const auto found =
            std::ranges::find_if(players_, [&](const auto& p) { return isSameName(p.second.name, wanted); });
        return found == players_.end() ? nullptr : &found->second;
    };
    const KnownPlayer* player = find(name);
    return player ? player : find(base::normalizedName(name));
}

const KnownPlayer* KnownPlayers::byLooks(std::string_view name, game::PlayerId id) const {
    const base::NameLooks looks = base::looksOf(name);
    for (const std::string& text : {looks.written, looks.folded})
        for (auto [at, end] = looks_.equal_range(text); at != end; ++at)
            if (at->second != id) return byId(at->second);
    return nullptr;
}

KnownPlayer& KnownPlayers::put(KnownPlayer player) {
    const base::NameLooks looks = base::looksOf(player.name);
    const auto [at, isNew] = players_.try_emplace(player.id);
    if (!isNew) removeLooks(at->second);
    for (const std::string& text : {looks.written, looks.folded}) looks_.emplace(text, player.id);
    at->second = std::move(player);
    return at->second;
}

void KnownPlayers::removeLooks(const KnownPlayer& player) {
    const base::NameLooks looks = base::looksOf(player.name);
    for (const std::string& text : {looks.written, looks.folded}) {
        const auto [begin, end] = looks_.equal_range(text);
        const auto own = std::find_if(begin, end, [&](const auto& look) { return look.second == player.id; });
        if (own != end) looks_.erase(own);
    }
}

const KnownPlayer& KnownPlayers::add(const PublicKey& key, const std::string& name, game::Role role,
                                     game::PlayerId number) {
    assert(!byKey(key) && !byName(name) && "somebody new");
    const game::PlayerId next = players_.empty() ? kFirstPlayer : players_.rbegin()->first + 1;
    const game::PlayerId id = number == game::kNoPlayer ? next : number;
    const KnownPlayer& player = put({id, key, name, role, {}, {}});
    records_->addPlayer(player);
    return player;
}

void KnownPlayers::learn(const KnownPlayer& player) {
    put(player);
}

void KnownPlayers::setClaims(const std::vector<game::Claim>& claims) {
    claims_ = {};
    for (const game::Claim& claim : claims) (void)claims_.add(claim);  // invalid claims are dropped
}

void KnownPlayers::forget(game::PlayerId id) {
    const auto found = players_.find(id);
    if (found == players_.end()) return;
    removeLooks(found->second);
    players_.erase(found);
}

void KnownPlayers::setName(game::PlayerId id, const std::string& name) {
    KnownPlayer player = players_.at(id);
    player.name = name;
    put(std::move(player));
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

base::Result<std::string> KnownPlayers::items(game::PlayerId id) {
    return records_->text(itemsTextOf(id));
}

void KnownPlayers::setItems(game::PlayerId id, const std::string& text) {
    records_->setText(itemsTextOf(id), text);
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
