// URLs of worlds: parsing, and that no message contains a password.
#include "terrane/store_postgres/address.h"

#include <gmock/gmock.h>

namespace terrane::store_postgres {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Address, WhatIsForPostgres) {
    EXPECT_TRUE(isPostgresUrl("postgresql://host/db"));
    EXPECT_TRUE(isPostgresUrl("postgres://host/db"));
    EXPECT_TRUE(isPostgresUrl("postgresql://"));
    for (const char* other : {"", "postgresql", "postgresql:/host", "mysql://host/db", "Postgresql://host/db",
                              " postgresql://host/db", "a.sqlite"})
        EXPECT_FALSE(isPostgresUrl(other)) << other;
}

TEST(Address, WhatIsShown) {
    const std::pair<const char*, const char*> cases[] = {
        {"postgresql://host/db", "postgresql://host/db"},
        {"postgres://me:secret@host:5432/db", "postgresql://host/db"},
        {"postgresql://me:secret@host:5433/db?connect_timeout=3", "postgresql://host:5433/db"},
        {"postgresql://me@a:1,b:2/db?password=secret", "postgresql://a,b:1,2/db"},
        {"postgresql:///db?host=/run/postgresql&user=me", "postgresql:///db"},
        {"postgresql:///db?hostaddr=10.0.0.3", "postgresql://10.0.0.3/db"},
        {"postgresql://[::1]/db?schema=w", "postgresql://::1/db?schema=w"},
        {"postgresql://host/d%0Ab?schema=a%0Ab", "postgresql://host/d\\x0ab?schema=a\\x0ab"},
    };
    for (const auto& [url, shown] : cases) {
        const auto address = addressOf(url);
        ASSERT_TRUE(address) << url;
        EXPECT_EQ(address->shown, shown);
    }
}

TEST(Address, TheSchemaIsAParameter) {
    struct Case {
        std::string url, schema, rest;
    };
    const std::string longest(63, 'x');
    const Case cases[] = {
        {"postgresql://h/d", "terrane", "postgresql://h/d"},
        {"postgresql://h/d?", "terrane", "postgresql://h/d"},
        {"postgresql://h/d?schema=w", "w", "postgresql://h/d"},
        {"postgresql://h/d?user=me&schema=w&port=1", "w", "postgresql://h/d?user=me&port=1"},
        {"postgresql://h/d?schema=w&&port=1", "w", "postgresql://h/d?port=1"},
        {"postgresql://h/d?schema=a%20%22b%22%3B%25", "a \"b\";%", "postgresql://h/d"},
        {"postgresql://h/d?schema=%c5%A1", "š", "postgresql://h/d"},
        {"postgresql://h/d?schema='\"", "'\"", "postgresql://h/d"},
        {"postgresql://h/d?schema=" + longest, longest, "postgresql://h/d"},
    };
    for (const Case& one : cases) {
        const auto address = addressOf(one.url);
        ASSERT_TRUE(address) << one.url;
        EXPECT_EQ(address->schema, one.schema);
        EXPECT_EQ(address->url, one.rest);
    }
}

TEST(Address, NoSchemaOfSuchAName) {
    for (const std::string& schema :
         {std::string(), std::string(64, 'x'), std::string("a%00b"), std::string("%24user")}) {
        const auto address = addressOf("postgresql://me:secret@h/d?schema=" + schema);
        ASSERT_FALSE(address) << schema;
        EXPECT_EQ(address.error().code, base::ErrorCode::BadInput);
        EXPECT_THAT(address.error().message, HasSubstr("a schema has a name of 1 to 63 bytes"));
        EXPECT_THAT(address.error().message, Not(HasSubstr("secret")));
    }
}

// Passwords with special characters of URLs are a common mistake.
TEST(Address, AMessageOfABadUrlHoldsNothingOfIt) {
    for (const char* url : {
             "postgresql://me:secret@host/db?nonsense=secret",
             "postgresql://me:secret@host/db?secret",
             "postgresql://me:sec%zzret@host/db",
             "postgresql://me:secret@[::1/db",
             "postgresql://me:secret/x@host/db",
             "postgresql://me:1/secret@host/db",
             "postgresql://me:x@secret@host/db",
             "postgresql://me:x?@secret@host/db",
             "postgresql://me:x/y?secret@host/db",
             "postgresql://host:secret/db",
         }) {
        const auto address = addressOf(url);
        ASSERT_FALSE(address) << url << " is shown as " << address->shown;
        EXPECT_EQ(address.error().code, base::ErrorCode::BadInput) << url;
        EXPECT_THAT(address.error().message, HasSubstr("not a URL of a database"));
        for (const char* part : {"secret", "me:", "db?", "\n"})
            EXPECT_THAT(address.error().message, Not(HasSubstr(part))) << url;
    }
}

TEST(Address, CodedCharactersAreNoMistake) {
    for (const char* url : {"postgresql://me:a%2Fb%40c@host/db", "postgresql://me:p?w@host/db",
                            "postgresql://host/a%40b", "postgresql:///db?user=a@b&host=@socket"})
        EXPECT_TRUE(addressOf(url)) << url;
}

}  // namespace
}  // namespace terrane::store_postgres
