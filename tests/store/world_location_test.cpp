#include "terrane/store/saves/save_path.h"

#include <gmock/gmock.h>

#include "terrane/store/saves/open_world.h"
#include "tests/store/store_fixture.h"

namespace terrane::store {
namespace {

using base::ErrorCode;
using testing::HasSubstr;
using testing::Not;
using Kind = WorldLocation::Kind;

TEST(WorldLocation, NamesFilesAndUrls) {
    for (const char* text : {"home", "my world", "a.b", "sqlite", "a.sqlite3", "a:b", ""})
        EXPECT_EQ(worldLocation(text).kind, Kind::Name) << text;
    for (const char* text : {"a.sqlite", ".sqlite", "./a", "/a/b", "folder/a.sqlite", "a/", "a:/b"})
        EXPECT_EQ(worldLocation(text).kind, Kind::File) << text;
    for (const char* text : {"postgresql://host/name", "postgresql://host/a.sqlite", "x://"})
        EXPECT_EQ(worldLocation(text).kind, Kind::Url) << text;
    EXPECT_EQ(worldLocation("home").text, "home");
}

TEST(WorldLocation, FilesOfLocations) {
    EXPECT_EQ(*fileOf(worldLocation("x/a.sqlite")), "x/a.sqlite");
    const auto named = fileOf(worldLocation("home"));
    ASSERT_TRUE(named) << named.error().message;
    EXPECT_EQ(named->filename(), "home.sqlite");
    EXPECT_EQ(fileOf(worldLocation("")).error().code, ErrorCode::BadInput);
    EXPECT_EQ(fileOf(worldLocation(".hidden")).error().code, ErrorCode::BadInput);
}

TEST(WorldLocation, AUrlIsNotSupportedAndItsPasswordNotPrinted) {
    const auto file = fileOf(worldLocation("postgresql://me:secret@host/name"));
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().code, ErrorCode::Unsupported);
    EXPECT_THAT(file.error().message, HasSubstr("postgresql"));
    EXPECT_THAT(file.error().message, HasSubstr("no URL of a world"));
    EXPECT_THAT(file.error().message, Not(HasSubstr("secret")));
}

TEST(WorldLocation, WhatIsNearlyAUrlIsNoFile) {
    for (const char* text :
         {"postgresql:/me:secret@host/name", "postgresql//me:secret@host/name", "postgres:me:secret@host",
          "PostgreSQL:me:secret", "postgresq://me:secret@host/name"}) {
        EXPECT_EQ(worldLocation(text).kind, Kind::Url) << text;
        EXPECT_THAT(fileOf(worldLocation(text)).error().message, Not(HasSubstr("secret"))) << text;
    }
    EXPECT_EQ(worldLocation("postgres").kind, Kind::Name);
    EXPECT_EQ(worldLocation("postgres/a.sqlite").kind, Kind::File);
}

TEST(MissingOf, WhatCannotBeReadIsNotMissing) {
    std::vector<LoadedChunk> stored(3);
    stored[0].chunk = std::make_shared<world::Chunk>();
    const std::vector<world::ChunkPos> positions{{0, 0}, {1, 0}, {2, 0}};
    EXPECT_EQ(*missingChunks(positions, stored), (std::vector<world::ChunkPos>{{1, 0}, {2, 0}}));
    stored[2].isUnreadable = true;
    stored[2].problem = "the network broke";
    EXPECT_EQ(missingChunks(positions, stored).error().message, "the network broke");
    stored[2].isOverBudget = true;
    EXPECT_EQ(missingChunks(positions, stored)->size(), 2u);
}

class OpenWorldTest : public testing::Test {
  protected:
    auto open(WorldAccess access, RequestedWorld world = {}) {
        WorldRequest request{
            .access = access, .create = {}, .world = std::move(world), .versionOf = {}, .limits = kNever};
        if (access != WorldAccess::ReadOnly) request.create = kIdentity;
        request.versionOf = [](std::string_view generator) { return generator == "flat" ? 3 : 0; };
        return openWorld(worldLocation(path_), registry_, request);
    }

    base::TempFolder folder_;
    std::string path_ = folder_ / "a.sqlite";
    world::BlockRegistry registry_ = testRegistry();
};

TEST_F(OpenWorldTest, ReadOnlyKeepsChangesInMemory) {
    const auto missing = open(WorldAccess::ReadOnly);
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::NotFound);
    {
        auto made = open(WorldAccess::ReadWrite);
        ASSERT_TRUE(made) << made.error().message;
        EXPECT_TRUE((*made)->isPersistent());
        (*made)->save({1, 2}, numberedChunk(1), Provenance::Edited);
        (*made)->setMetadata("player", "1,2,3");
    }
    const std::string before = readAll(path_);
    {
        auto store = open(WorldAccess::ReadOnly);
        ASSERT_TRUE(store) << store.error().message;
        EXPECT_FALSE((*store)->isPersistent());
        EXPECT_EQ(*(*store)->load({1, 2}).chunk, *numberedChunk(1));
        EXPECT_EQ((*store)->metadata("player"), "1,2,3");
        (*store)->save({1, 2}, numberedChunk(2), Provenance::Generated);
        EXPECT_EQ(*(*store)->load({1, 2}).chunk, *numberedChunk(1)) << "edited below";
        (*store)->save({1, 2}, numberedChunk(3), Provenance::Edited);
        EXPECT_EQ(*(*store)->load({1, 2}).chunk, *numberedChunk(3));
        (*store)->setMetadata("player", "4");
        EXPECT_EQ((*store)->metadata("player"), "4");
        ASSERT_TRUE((*store)->flush());
    }
    EXPECT_TRUE(readAll(path_) == before);
}

TEST_F(OpenWorldTest, ErrorsHaveCodes) {
    { ASSERT_TRUE(open(WorldAccess::ReadWrite)); }
    for (const WorldAccess access : {WorldAccess::ReadOnly, WorldAccess::ReadWrite})
        EXPECT_EQ(open(access, {.seed = 8, .generator = {}}).error().code, ErrorCode::Incompatible);
    {
        const auto first = open(WorldAccess::ReadWrite);
        EXPECT_EQ(open(WorldAccess::ReadWrite).error().code, ErrorCode::Busy);
        EXPECT_TRUE(open(WorldAccess::ReadOnly)) << "readers see what is saved";
    }
    const std::string whole = readAll(path_);
    writeAll(path_, std::string_view(whole).substr(0, whole.size() - 1));
    EXPECT_EQ(open(WorldAccess::ReadWrite).error().code, ErrorCode::Damaged);
    writeAll(path_, "a text");
    EXPECT_EQ(open(WorldAccess::ReadWrite).error().code, ErrorCode::Incompatible);
    path_ = "postgresql://host/name";
    EXPECT_EQ(open(WorldAccess::ReadWrite).error().code, ErrorCode::Unsupported);
}

TEST_F(OpenWorldTest, NeedsTheVersionsOfGenerators) {
    const auto opened =
        openWorld(worldLocation(path_), registry_,
                  {.access = {}, .create = kIdentity, .world = {}, .versionOf = {}, .limits = kNever});
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().code, ErrorCode::BadInput);
    EXPECT_FALSE(std::filesystem::exists(path_));
}

}  // namespace
}  // namespace terrane::store
