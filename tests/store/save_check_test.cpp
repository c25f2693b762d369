#include "terrane/store/save_check.h"

#include <gmock/gmock.h>

#include "terrane/store/chunk_key.h"
#include "terrane/store/schema.h"
#include "terrane/store/sqlite_store.h"
#include "tests/store/store_fixture.h"

namespace terrane::store {
namespace {

using testing::HasSubstr;

class SaveCheckTest : public testing::Test {
  protected:
    void SetUp() override {
        const auto store = SqliteStore::open(path_, registry_, {.create = kIdentity, .decide = {}});
        ASSERT_TRUE(store);
        for (int x = 0; x < 30; ++x)
            (*store)->save({x, -x}, numberedChunk(x),
                           x % 3 == 0 ? Provenance::Edited : Provenance::Generated);
    }
    CheckReport check() {
        auto report = checkSave(path_, registry_);
        if (!report) throw std::runtime_error(report.error().message);
        return *report;
    }

    base::TempFolder folder_;
    std::filesystem::path path_ = folder_ / "a.sqlite";
    world::BlockRegistry registry_ = testRegistry();
};

TEST_F(SaveCheckTest, GoodSave) {
    const std::string before = readAll(path_);
    const CheckReport report = check();
    EXPECT_FALSE(report.isDamaged());
    EXPECT_EQ(report.chunks, 30u);
    EXPECT_EQ(report.editedChunks, 10u);
    EXPECT_EQ(report.identity, kIdentity);
    EXPECT_EQ(report.format, kFormatVersion);
    EXPECT_EQ(report.fileBytes, before.size());
    EXPECT_GT(report.chunkBytes, 30u * 40);
    EXPECT_TRUE(report.unknownBlocks.empty());
    EXPECT_TRUE(readAll(path_) == before);
    EXPECT_EQ(folder_.fileCount(), 1);
}

TEST_F(SaveCheckTest, NamesEveryDamagedChunk) {
    runSql(path_, fmt::format("UPDATE chunks SET data = x'00' WHERE key = {}", keyOf({4, -4})));
    runSql(path_, fmt::format("UPDATE chunks SET data = zeroblob(100) WHERE key = {}", keyOf({9, -9})));
    runSql(path_, "INSERT INTO chunks VALUES (-3, 0, x'00')");
    const CheckReport report = check();
    EXPECT_TRUE(report.isDamaged());
    ASSERT_EQ(report.damaged.size(), 3u);
    EXPECT_THAT(report.damaged[0].problem, HasSubstr("key -3"));
    EXPECT_EQ(report.damaged[1].pos, (world::ChunkPos{4, -4}));
    EXPECT_THAT(report.damaged[1].problem, HasSubstr("too few"));
    EXPECT_EQ(report.damaged[2].pos, (world::ChunkPos{9, -9}));
    EXPECT_THAT(report.damaged[2].problem, HasSubstr("checksum"));
    EXPECT_TRUE(report.fileProblems.empty());
}

TEST_F(SaveCheckTest, LooksAtAllLevels) {
    {
        const auto store = SqliteStore::open(path_, registry_, {});
        ASSERT_TRUE(store);
        (*store)->save({3, 4, 5}, numberedChunk(1), Provenance::Edited);
    }
    EXPECT_EQ(check().chunks, 31u);
    EXPECT_FALSE(check().isDamaged());
    runSql(path_, fmt::format("UPDATE chunks SET data = x'00' WHERE key = {}", keyOf({3, 4, 5})));
    ASSERT_EQ(check().damaged.size(), 1u);
    EXPECT_EQ(check().damaged[0].pos, (world::ChunkPos{3, 4, 5}));
}

TEST_F(SaveCheckTest, UnknownBlocksAreNoDamage) {
    const auto report = checkSave(path_, registryOf({"stone", "dirt"}));
    ASSERT_TRUE(report);
    EXPECT_FALSE(report->isDamaged());
    EXPECT_EQ(report->unknownBlocks, (std::vector<std::string>{"grass", "sand", "water"}));
}

TEST_F(SaveCheckTest, BrokenPagesAndCutFiles) {
    std::string bytes = readAll(path_);
    const std::string whole = bytes;
    for (std::size_t i = bytes.size() - 4096; i < bytes.size() - 4000; ++i) bytes[i] = '\x55';
    writeAll(path_, bytes);
    EXPECT_FALSE(check().fileProblems.empty());
    writeAll(path_, std::string_view(whole).substr(0, whole.size() - 4096));
    ASSERT_EQ(check().fileProblems.size(), 1u);
    EXPECT_THAT(check().fileProblems[0], HasSubstr("cut off"));
}

TEST_F(SaveCheckTest, WhatIsNoSaveIsAnError) {
    EXPECT_FALSE(checkSave(folder_ / "nothing", registry_));
    writeAll(path_, "a text");
    EXPECT_FALSE(checkSave(path_, registry_));
}

}  // namespace
}  // namespace terrane::store
