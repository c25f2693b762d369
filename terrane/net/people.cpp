#include "terrane/net/people.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cstring>
#include <utility>
#include <vector>

#include "terrane/game/pose_text.h"
#include "terrane/net/wire.h"

namespace terrane::net {
namespace {

// kNoPlayer and kLocalPlayer are nobody's.
constexpr game::PlayerId kFirstPlayer = game::kLocalPlayer + 1;

std::string lower(std::string_view name) {
    std::string text(name);
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

tl::unexpected<base::Error> damaged(store::Database& database, std::string_view what) {
    return base::fail(base::ErrorCode::Damaged, "{}: damaged: {}", database.path(), what);
}

// "3 7 12", and back. Nothing where some word is no number.
std::string textOf(const std::vector<game::PlayerId>& members) {
    std::string text;
    for (const game::PlayerId member : members) text += fmt::format("{}{}", text.empty() ? "" : " ", member);
    return text;
}

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

std::optional<KnownPlayer> playerOf(const store::Statement& row) {
    KnownPlayer player;
    const ByteView key = row.blob(1);
    const std::int64_t id = row.number(0), role = row.number(3);
    if (key.size() != player.key.size() || id < kFirstPlayer || id > 0xFFFFFFFF) return std::nullopt;
    if (role < 0 || role >= static_cast<std::int64_t>(game::Role::Count)) return std::nullopt;
    std::ranges::copy(key, player.key.begin());
    player.id = static_cast<game::PlayerId>(id);
    player.name = row.text(2);
    player.role = static_cast<game::Role>(role);
    player.pose = game::poseFrom(std::string(row.text(4)));
    player.ban = row.text(5);
    return player;
}

}  // namespace

bool isName(std::string_view name) {
    return !name.empty() && name.size() <= kMaxNameBytes && isPlainText(name) && name.front() != ' ' &&
           name.back() != ' ' && name.find('"') == std::string_view::npos && name != "*";
}

std::string nameRule() {
    return fmt::format("a name has 1 to {} bytes, no quotation mark and no spaces at its ends",
                       kMaxNameBytes);
}

base::Result<People> People::read(ServerFile& file) {
    People people(file);
    if (auto done = people.readPlayers(); !done) return tl::unexpected(done.error());
    if (auto done = people.readClaims(); !done) return tl::unexpected(done.error());
    return people;
}

base::Result<void> People::readPlayers() {
    const auto take = [&](const store::Statement& row) -> base::Result<void> {
        auto player = playerOf(row);
        if (!player) return damaged(file_->reader(), "a player");
        players_.insert({player->id, std::move(*player)});
        return {};
    };
    return store::forEachRow(file_->reader(), "SELECT id, key, name, role, pose, ban FROM players", take);
}

base::Result<void> People::readClaims() {
    const auto take = [&](const store::Statement& row) -> base::Result<void> {
        const auto at = [&](int column) { return static_cast<std::int32_t>(row.number(column)); };
        auto members = membersFrom(row.text(6));
        if (!members) return damaged(file_->reader(), "a claim");
        const auto added = claims_.add({std::string(row.text(0)),
                                        {at(1), at(2), at(3), at(4)},
                                        static_cast<game::PlayerId>(row.number(5)),
                                        std::move(*members)});
        return added ? added : damaged(file_->reader(), added.error().message);
    };
    return store::forEachRow(file_->reader(), "SELECT name, x0, y0, x1, y1, owner, members FROM claims",
                             take);
}

const KnownPlayer* People::byId(game::PlayerId id) const {
    const auto found = players_.find(id);
    return found == players_.end() ? nullptr : &found->second;
}

const KnownPlayer* People::byKey(const PublicKey& key) const {
    const auto found = std::ranges::find_if(players_, [&](const auto& p) { return p.second.key == key; });
    return found == players_.end() ? nullptr : &found->second;
}

const KnownPlayer* People::byName(std::string_view name) const {
    const auto found =
        std::ranges::find_if(players_, [&](const auto& p) { return lower(p.second.name) == lower(name); });
    return found == players_.end() ? nullptr : &found->second;
}

const KnownPlayer& People::add(const PublicKey& key, const std::string& name, game::Role role) {
    assert(!byKey(key) && !byName(name) && "somebody new");
    const game::PlayerId id = players_.empty() ? kFirstPlayer : players_.rbegin()->first + 1;
    const KnownPlayer& player = players_.insert({id, {id, key, name, role, {}, {}}}).first->second;
    save(player);
    return player;
}

void People::setName(game::PlayerId id, const std::string& name) {
    players_.at(id).name = name;
    save(players_.at(id));
}

void People::setRole(game::PlayerId id, game::Role role) {
    players_.at(id).role = role;
    save(players_.at(id));
}

void People::setPose(game::PlayerId id, const world::Pose& pose) {
    players_.at(id).pose = pose;
    save(players_.at(id));
}

void People::setBan(game::PlayerId id, const std::string& reason) {
    players_.at(id).ban = reason;
    save(players_.at(id));
}

void People::save(const KnownPlayer& player) {
    file_->write([player](store::Database& database) -> base::Result<void> {
        auto put = database.prepare(
            "INSERT OR REPLACE INTO players (id, key, name, role, pose, ban) VALUES (?1, ?2, ?3, ?4, ?5, "
            "?6)");
        if (!put) return tl::unexpected(put.error());
        put->bind(1, std::int64_t{player.id});
        put->bind(2, ByteView(player.key));
        put->bind(3, player.name);
        put->bind(4, static_cast<std::int64_t>(player.role));
        put->bind(5, player.pose ? game::textOf(*player.pose) : std::string());
        put->bind(6, player.ban);
        return put->run();
    });
}

base::Result<void> People::addClaim(const game::Claim& claim) {
    if (auto added = claims_.add(claim); !added) return added;
    file_->write([claim](store::Database& database) -> base::Result<void> {
        auto put = database.prepare(
            "INSERT INTO claims (name, x0, y0, x1, y1, owner, members) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)");
        if (!put) return tl::unexpected(put.error());
        put->bind(1, claim.name);
        int column = 2;
        for (const std::int32_t v : {claim.area.x0, claim.area.y0, claim.area.x1, claim.area.y1})
            put->bind(column++, std::int64_t{v});
        put->bind(6, std::int64_t{claim.owner});
        put->bind(7, textOf(claim.members));
        return put->run();
    });
    return {};
}

bool People::removeClaim(std::string_view name) {
    if (!claims_.remove(name)) return false;
    file_->write([name = std::string(name)](store::Database& database) -> base::Result<void> {
        auto erase = database.prepare("DELETE FROM claims WHERE name = ?1");
        if (!erase) return tl::unexpected(erase.error());
        erase->bind(1, name);
        return erase->run();
    });
    return true;
}

}  // namespace terrane::net
