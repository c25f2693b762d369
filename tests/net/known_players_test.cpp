#include "terrane/net/server/known_players.h"

#include "tests/net/server_file_fixture.h"

namespace terrane::net {
namespace {

PublicKey keyOf(int number) {
    PublicKey key{};
    key[0] = static_cast<std::byte>(number);
    return key;
}

class KnownPlayersTest : public RecordsTest {
  protected:
    KnownPlayersTest() : known_(KnownPlayers::read(*records_).value()) {}
    void reopen() {
        open();
        known_ = KnownPlayers::read(*records_).value();
    }
    KnownPlayers known_;
};

TEST_F(KnownPlayersTest, AreKept) {
    const game::PlayerId anna = known_.add(keyOf(1), "Anna", game::Role::Player).id;
    const game::PlayerId bert = known_.add(keyOf(2), "Bert", game::Role::Operator).id;
    EXPECT_NE(anna, bert);
    const world::Pose pose{{1.5, -2.5, 70.25}, 90, -10};
    known_.setPose(anna, pose);
    known_.setRole(anna, game::Role::Guest);
    known_.setBan(bert, "broke what others built");
    known_.setName(bert, "Bertram");
    reopen();
    ASSERT_TRUE(known_.byKey(keyOf(1)));
    EXPECT_EQ(known_.byKey(keyOf(1))->id, anna);
    EXPECT_EQ(known_.byId(anna)->pose, pose);
    EXPECT_EQ(known_.byId(anna)->role, game::Role::Guest);
    EXPECT_EQ(known_.byName("BERTRAM")->ban, "broke what others built");
    EXPECT_EQ(known_.byName("Bert"), nullptr);
    EXPECT_EQ(known_.byKey(keyOf(3)), nullptr);
    EXPECT_GT(known_.add(keyOf(3), "Carl", game::Role::Player).id, bert) << "numbers are not used again";
}

TEST_F(KnownPlayersTest, ClaimsAreKept) {
    ASSERT_TRUE(known_.addClaim({"farm", {-5, -6, 7, 8}, 2, {3, 4}}));
    ASSERT_TRUE(known_.addClaim({"tower", {100, 100, 110, 110}, 3, {}}));
    EXPECT_FALSE(known_.addClaim({"barn", {7, 8, 9, 9}, 2, {}}));
    EXPECT_TRUE(known_.removeClaim("tower"));
    EXPECT_FALSE(known_.removeClaim("tower"));
    reopen();
    ASSERT_EQ(known_.claims().all().size(), 1u);
    const game::Claim& farm = *known_.claims().find("farm");
    EXPECT_EQ(farm.area, (game::ColumnArea{-5, -6, 7, 8}));
    EXPECT_EQ(farm.owner, 2u);
    EXPECT_EQ(farm.members, (std::vector<game::PlayerId>{3, 4}));
}

TEST_F(KnownPlayersTest, DamagedRowsAreRefused) {
    known_.add(keyOf(1), "Anna", game::Role::Player);
    flush();
    for (const char* change : {"UPDATE players SET role = 9", "UPDATE players SET role = 1, key = x'00'"}) {
        records_->file().write([&](store::Database& database) { return database.execute(change); });
        flush();
        EXPECT_FALSE(KnownPlayers::read(*records_)) << change;
    }
}

TEST_F(KnownPlayersTest, LookAlikesAreFound) {
    const game::PlayerId anna = known_.add(keyOf(1), "Anna", game::Role::Player).id;
    reopen();
    const auto like = [&](std::string_view name, game::PlayerId id = game::kNoPlayer) {
        const KnownPlayer* player = known_.byLooks(name, id);
        return player ? player->id : game::kNoPlayer;
    };
    for (const char* name : {"Anna", "ANNA", "\u0391nna", "Anna\u200b"}) EXPECT_EQ(like(name), anna) << name;
    EXPECT_EQ(like("Anna", anna), game::kNoPlayer) << "it is the player itself";
    EXPECT_EQ(like("Ann"), game::kNoPlayer);
    known_.setName(anna, "Berta");
    EXPECT_EQ(like("Anna"), game::kNoPlayer);
    EXPECT_EQ(like("berta"), anna);
    known_.learn({anna, keyOf(1), "Carla", game::Role::Player, {}, {}});
    EXPECT_EQ(like("berta"), game::kNoPlayer);
    EXPECT_EQ(like("CARLA"), anna);
    known_.forget(anna);
    EXPECT_EQ(like("Carla"), game::kNoPlayer);
}

TEST(NewName, FollowsTheRule) {
    for (const char* good : {"A", "Žofie", "a b", "123456789012345678901234"})
        EXPECT_TRUE(newName(good)) << good;
    for (const char* bad : {"", " a", "a\"b", "*", "Server", "server", "Ann\u200b", "\u0391nn", "\xFF",
                            "1234567890123456789012345"})
        EXPECT_FALSE(newName(bad)) << bad;
    EXPECT_EQ(newName("A\u0301nna").value(), "\u00c1nna");
}

TEST(IsName, TakesPlainShortNames) {
    for (const char* good : {"A", "Žofie", "a b", "123456789012345678901234"})
        EXPECT_TRUE(isName(good)) << good;
    for (const char* bad : {"", " a", "a ", "a\nb", "1234567890123456789012345", "\xFF"})
        EXPECT_FALSE(isName(bad)) << bad;
}

}  // namespace
}  // namespace terrane::net
