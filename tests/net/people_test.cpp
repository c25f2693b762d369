#include "terrane/net/server/people.h"

#include "tests/net/server_file_fixture.h"

namespace terrane::net {
namespace {

PublicKey keyOf(int number) {
    PublicKey key{};
    key[0] = static_cast<std::byte>(number);
    return key;
}

class PeopleTest : public RecordsTest {
  protected:
    PeopleTest() : people_(People::read(*records_).value()) {}
    void reopen() {
        open();
        people_ = People::read(*records_).value();
    }
    People people_;
};

TEST_F(PeopleTest, AreKept) {
    const game::PlayerId anna = people_.add(keyOf(1), "Anna", game::Role::Player).id;
    const game::PlayerId bert = people_.add(keyOf(2), "Bert", game::Role::Operator).id;
    EXPECT_NE(anna, bert);
    const world::Pose pose{{1.5, -2.5, 70.25}, 90, -10};
    people_.setPose(anna, pose);
    people_.setRole(anna, game::Role::Guest);
    people_.setBan(bert, "broke what others built");
    people_.setName(bert, "Bertram");
    reopen();
    ASSERT_TRUE(people_.byKey(keyOf(1)));
    EXPECT_EQ(people_.byKey(keyOf(1))->id, anna);
    EXPECT_EQ(people_.byId(anna)->pose, pose);
    EXPECT_EQ(people_.byId(anna)->role, game::Role::Guest);
    EXPECT_EQ(people_.byName("BERTRAM")->ban, "broke what others built");
    EXPECT_EQ(people_.byName("Bert"), nullptr);
    EXPECT_EQ(people_.byKey(keyOf(3)), nullptr);
    EXPECT_GT(people_.add(keyOf(3), "Carl", game::Role::Player).id, bert) << "numbers are not used again";
}

TEST_F(PeopleTest, ClaimsAreKept) {
    ASSERT_TRUE(people_.addClaim({"farm", {-5, -6, 7, 8}, 2, {3, 4}}));
    ASSERT_TRUE(people_.addClaim({"tower", {100, 100, 110, 110}, 3, {}}));
    EXPECT_FALSE(people_.addClaim({"barn", {7, 8, 9, 9}, 2, {}}));
    EXPECT_TRUE(people_.removeClaim("tower"));
    EXPECT_FALSE(people_.removeClaim("tower"));
    reopen();
    ASSERT_EQ(people_.claims().all().size(), 1u);
    const game::Claim& farm = *people_.claims().find("farm");
    EXPECT_EQ(farm.area, (game::ColumnArea{-5, -6, 7, 8}));
    EXPECT_EQ(farm.owner, 2u);
    EXPECT_EQ(farm.members, (std::vector<game::PlayerId>{3, 4}));
}

TEST_F(PeopleTest, DamagedRowsAreRefused) {
    people_.add(keyOf(1), "Anna", game::Role::Player);
    flush();
    for (const char* change : {"UPDATE players SET role = 9", "UPDATE players SET role = 1, key = x'00'"}) {
        records_->file().write([&](store::Database& database) { return database.execute(change); });
        flush();
        EXPECT_FALSE(People::read(*records_)) << change;
    }
}

TEST(IsName, TakesPlainShortNames) {
    for (const char* good : {"A", "Žofie", "a b", "123456789012345678901234"})
        EXPECT_TRUE(isName(good)) << good;
    for (const char* bad : {"", " a", "a ", "a\nb", "1234567890123456789012345", "\xFF"})
        EXPECT_FALSE(isName(bad)) << bad;
}

}  // namespace
}  // namespace terrane::net
