// Names and values of any bytes: kept or rejected, but never read as SQL.
#include "tests/store_postgres/world_fixture.h"

namespace terrane::store_postgres {
namespace {

using store::Provenance;
using testing::HasSubstr;

const std::string kOddTexts[] = {
    "two words",
    "UPPER and lower",
    "'",
    "\"",
    "it's \"quoted\"",
    "a;b",
    "\\",
    "\\x41",
    "a\\'b",
    "$1",
    "%s%n",
    "'; DROP TABLE chunks; --",
    "\"; DROP TABLE chunks; --",
    "$$; DROP TABLE chunks; $$",
    "/*",
    "--",
    "{}",
    "žluťoučký kůň",
    "日本語 \U0001F30D",
    "line\nline\ttab\r",
    "\x01\x7f",
    "null",
    "",
    " ",
};
const std::string kNoTexts[] = {
    std::string("a\0b", 3),
    "\xff",
    "a\x80",
    "\xc3",
    "\xc0\xaf",
    "\xed\xa0\x80",
    "\xf4\x90\x80\x80",
    "\xe2\x82",
    "\xf5\x80\x80\x80",
};

const std::string kOddSchemas[] = {
    "two Words",
    "it's \"quoted\"; $$ %s \\",
    "'; DROP TABLE chunks; --",
    "\"; DROP TABLE chunks; --",
    "kůň 日本語 \U0001F30D",
    "line\nline\t\x01",
    "null",
    " ",
};

std::string percentCoded(const std::string& text) {
    std::string coded;
    for (const char c : text) coded += fmt::format("%{:02x}", static_cast<unsigned char>(c));
    return coded;
}

class NamesTest : public PostgresWorldTest {};

// Each schema is a separate world, and others are not changed.
TEST_F(NamesTest, Schemas) {
    makeWorld();
    for (const std::string& name : kOddSchemas) {
        SCOPED_TRACE(name);
        const Address address = addressIn(sharedServer(), percentCoded(name));
        EXPECT_EQ(address.schema, name);
        {
            const auto store = PostgresStore::open(address, registry_, kCreateWorld);
            ASSERT_TRUE(store) << store.error().message;
            (*store)->save({7, 7}, store::numberedChunk(7), Provenance::Edited);
        }
        const auto reader = openReader(address, registry_);
        ASSERT_TRUE(reader) << reader.error().message;
        EXPECT_EQ(*(*reader)->load({7, 7}).chunk, *store::numberedChunk(7));
        ASSERT_TRUE(PostgresStore::open(address, registry_, regenerateBy(9)));
        const Address copy = addressIn(sharedServer(), percentCoded(name + "_backup_1"));
        const auto backup = openReader(copy, registry_);
        ASSERT_TRUE(backup) << backup.error().message;
        EXPECT_EQ(*(*backup)->load({7, 7}).chunk, *store::numberedChunk(7));
    }
    EXPECT_EQ(*open()->load({2, 0}).chunk, *store::numberedChunk(2));
    EXPECT_EQ(query("SELECT count(*) FROM chunks"), "3");
}

TEST_F(NamesTest, SchemasThatPostgresHasItself) {
    for (const char* name : {"pg_catalog", "information_schema", "pg_world", "pg_temp", "%ff", "a%c3"}) {
        SCOPED_TRACE(name);
        const Address address = addressIn(sharedServer(), name);
        const base::Error error = errorOf(PostgresStore::open(address, registry_, kCreateWorld));
        EXPECT_THAT(error.message, testing::StartsWith(address.shown + ": "));
        EXPECT_EQ(error.message.find_first_of("\n\xff"), std::string::npos);
    }
}

// The name of a backup is shortened at a character boundary.
TEST_F(NamesTest, BackupsOfLongNames) {
    std::string name = "x";
    while (name.size() + 3 <= 63) name += "日";
    address_ = addressIn(sharedServer(), percentCoded(name));
    makeWorld();
    ASSERT_TRUE(tryOpen(regenerateBy(9))) << errorOf(tryOpen(regenerateBy(9))).message;
    address_ = addressIn(sharedServer(), percentCoded(name.substr(0, 46) + "_backup_1"));
    const auto backup = openReader(address_, registry_);
    ASSERT_TRUE(backup) << backup.error().message;
    EXPECT_EQ(*(*backup)->load({2, 0}).chunk, *store::numberedChunk(2));
}

TEST_F(NamesTest, Metadata) {
    const auto store = open();
    for (const std::string& text : kOddTexts) {
        store->setMetadata("name " + text, "value " + text);
        store->setMetadata(text + "=", text);
    }
    store->save({0, 0}, store::numberedChunk(1), Provenance::Edited);
    ASSERT_TRUE(store->flush());
    const auto reader = openReader(address_, registry_);
    ASSERT_TRUE(reader) << reader.error().message;
    for (const std::string& text : kOddTexts) {
        EXPECT_EQ((*reader)->metadata("name " + text), "value " + text);
        EXPECT_EQ((*reader)->metadata(text + "="), text);
    }
    EXPECT_EQ(query("SELECT count(*) FROM settings"), std::to_string(3 + 2 * std::size(kOddTexts)));
    EXPECT_EQ(query("SELECT count(*) FROM chunks"), "1");
}

// PostgreSQL cannot store such text. The rest of the batch is saved.
TEST_F(NamesTest, MetadataThatIsNoTextIsLeftOut) {
    const auto store = open();
    for (const std::string& text : kNoTexts) {
        store->setMetadata("value", text);
        store->setMetadata(text, "value");
        store->setMetadata("player", "1,2");
        store->save({0, 0}, store::numberedChunk(1), Provenance::Edited);
        testing::internal::CaptureStderr();
        const auto flushed = store->flush();
        const std::string log = testing::internal::GetCapturedStderr();
        ASSERT_TRUE(flushed) << flushed.error().message;
        EXPECT_THAT(log, HasSubstr("the setting value is not a text in UTF-8, and is not saved"));
        EXPECT_EQ(std::ranges::count(log, '\n'), 2) << log;
        EXPECT_EQ(log.find('\xff'), std::string::npos);
        EXPECT_EQ(query("SELECT count(*) FROM settings"), "4") << "the world's three, and player";
        EXPECT_EQ(query("SELECT count(*) FROM chunks"), "1");
        sql("DELETE FROM chunks; DELETE FROM settings WHERE name = 'player'");
    }
}

TEST_F(NamesTest, Blocks) {
    store::SaveAccess access = kCreateWorld;
    for (const std::string& text : kOddTexts)
        access.blockNames.push_back(
            {static_cast<world::BlockId>(access.blockNames.size() + 100), "b" + text});
    ASSERT_TRUE(tryOpen(access)) << errorOf(tryOpen(access)).message;
    const auto rows = openRowsToRead(address_, registry_);
    ASSERT_TRUE(rows) << rows.error().message;
    const std::vector<store::SavedName>& names = (*rows)->ids().names();
    for (const store::SavedName& wanted : access.blockNames) {
        const auto found = std::ranges::find(names, wanted.id, &store::SavedName::id);
        ASSERT_NE(found, names.end());
        EXPECT_EQ(found->name, wanted.name);
    }
    EXPECT_EQ(query("SELECT count(*) FROM chunks"), "0");
}

// A world without some names would show other blocks, so it is not created.
TEST_F(NamesTest, BlocksWithoutATextAreAnError) {
    for (const std::string& text : kNoTexts) {
        store::SaveAccess access = kCreateWorld;
        access.blockNames = {{100, text}};
        expectError(errorOf(tryOpen(access)), base::ErrorCode::Failed, address_.shown,
                    "invalid byte sequence");
    }
    EXPECT_EQ(query("SELECT count(*) FROM pg_namespace WHERE nspname = '" + schema_ + "'"), "0");
}

}  // namespace
}  // namespace terrane::store_postgres
