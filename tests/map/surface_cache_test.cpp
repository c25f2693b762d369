#include "terrane/map/surface_cache.h"

#include <gmock/gmock.h>

#include <thread>

#include "tests/base/file_size_limit.h"
#include "tests/map/map_fixture.h"
#include "tests/store/store_fixture.h"

namespace terrane::map {
namespace {

using testing::HasSubstr;
using Columns = std::vector<SurfaceColumn>;
constexpr std::int64_t kPlenty = 64 << 20;

// Columns that depend on a number; each random one takes about four bytes.
Columns numberedColumns(int number, int randomCount = 0) {
    Columns columns(kColumnsOfBlob, {static_cast<world::BlockId>(number), 1, 90, 80});
    std::mt19937 random(static_cast<unsigned>(number));
    for (int k = 0; k < randomCount; ++k) columns[static_cast<std::size_t>(k)] = randomColumn(random);
    return columns;
}

class SurfaceCacheTest : public testing::Test {
  protected:
    std::unique_ptr<SurfaceCache> open(std::int64_t maxBytes = kPlenty,
                                       const std::string& origin = "world 1") {
        auto cache = SurfaceCache::open(path_, origin, maxBytes);
        if (!cache) throw std::runtime_error(cache.error().message);
        return std::move(*cache);
    }
    std::int64_t fileBytes() const { return static_cast<std::int64_t>(std::filesystem::file_size(path_)); }

    base::TempFolder folder_;
    std::filesystem::path path_ = folder_ / "map.sqlite";
};

TEST_F(SurfaceCacheTest, GivesWhatWasPut) {
    const auto cache = open();
    EXPECT_FALSE(cache->find({0, 0, 0}));
    EXPECT_FALSE(cache->contains({0, 0, 0}));
    cache->put({0, 0, 0}, numberedColumns(1));
    cache->put({-1, 0, 0}, numberedColumns(2));
    cache->put({-1, 0, 10}, numberedColumns(3));
    cache->put({-1, 0, 0}, numberedColumns(4));
    EXPECT_EQ(cache->find({0, 0, 0}), numberedColumns(1));
    EXPECT_EQ(cache->find({-1, 0, 0}), numberedColumns(4)) << "the newest one";
    EXPECT_EQ(cache->find({-1, 0, 10}), numberedColumns(3));
    EXPECT_FALSE(cache->find({0, -1, 0}));
}

TEST_F(SurfaceCacheTest, OneFileKeepsItForTheNextProgram) {
    open()->put({3, -4, 2}, numberedColumns(5, 100));
    EXPECT_EQ(folder_.fileCount(), 1) << "no log and no lock";
    const auto cache = open();
    EXPECT_TRUE(cache->contains({3, -4, 2}));
    EXPECT_GT(cache->bytes(), 0);
    EXPECT_EQ(cache->find({3, -4, 2}), numberedColumns(5, 100));
}

// Rows of all sizes: some share a page, some leave half of one empty, some are large.
TEST_F(SurfaceCacheTest, TheFileStaysWithinItsBytes) {
    constexpr std::int64_t kMost = 400000;
    for (const int randomCount : {0, 250, 400, 700, 9000}) {
        const auto cache = open(kMost, "world of " + std::to_string(randomCount));
        const std::int64_t size =
            static_cast<std::int64_t>(encodeSurfaces(numberedColumns(0, randomCount)).size());
        const auto count = static_cast<int>(std::min<std::int64_t>(kMost * 3 / 2 / size, 200));
        for (int k = 0; k < count; ++k) cache->put({k, 0, 0}, numberedColumns(k, randomCount));
        EXPECT_LE(cache->bytes(), kMost);
        EXPECT_LE(fileBytes(), kMost) << count << " rows of " << size << " bytes";
        EXPECT_TRUE(cache->contains({count - 1, 0, 0})) << "room was made for the last one";
    }
}

TEST_F(SurfaceCacheTest, ForgetsWhatWasNotUsedForLongest) {
    std::int64_t each = 0;
    {
        const auto cache = open();
        cache->put({0, 0, 0}, numberedColumns(0, 20000));
        each = cache->bytes();
        cache->put({1, 0, 0}, numberedColumns(1, 20000));
        cache->put({2, 0, 0}, numberedColumns(2, 20000));
        EXPECT_TRUE(cache->find({0, 0, 0}));
    }
    // Room for three and some: the order of uses is that of the former program.
    const auto cache = open(each * 4);
    cache->put({3, 0, 0}, numberedColumns(3, 20000));
    EXPECT_FALSE(cache->contains({1, 0, 0}));
    EXPECT_TRUE(cache->contains({0, 0, 0}));
    EXPECT_TRUE(cache->find({2, 0, 0}));
    cache->put({4, 0, 0}, numberedColumns(4, 20000));
    EXPECT_FALSE(cache->contains({0, 0, 0}));
    EXPECT_TRUE(cache->contains({2, 0, 0}));
    EXPECT_EQ(cache->find({3, 0, 0}), numberedColumns(3, 20000));
}

TEST_F(SurfaceCacheTest, TheOrderOfUsesTakesNoRoom) {
    std::int64_t bytes = 0;
    {
        const auto cache = open();
        for (int k = 0; k < 3; ++k) cache->put({k, 0, 0}, numberedColumns(k, 20000));
        for (int k = 0; k < 300; ++k) EXPECT_TRUE(cache->find({k % 2, 0, 0}));
        bytes = fileBytes();
    }
    EXPECT_EQ(fileBytes(), bytes);
}

TEST_F(SurfaceCacheTest, WhatIsTooLargeIsNotKept) {
    const auto cache = open(20000);
    cache->put({0, 0, 0}, numberedColumns(0));
    cache->put({1, 0, 0}, numberedColumns(1, 20000));
    EXPECT_FALSE(cache->contains({1, 0, 0}));
    EXPECT_FALSE(cache->find({1, 0, 0}));
    EXPECT_LE(cache->bytes(), 20000);
}

TEST_F(SurfaceCacheTest, AFileOfAnotherWorldIsReplaced) {
    open(kPlenty, "world 1")->put({0, 0, 0}, numberedColumns(1));
    {
        const auto cache = open(kPlenty, "world 2");
        EXPECT_FALSE(cache->contains({0, 0, 0}));
        EXPECT_EQ(cache->bytes(), 0);
        cache->put({0, 0, 0}, numberedColumns(2));
    }
    EXPECT_EQ(open(kPlenty, "world 2")->find({0, 0, 0}), numberedColumns(2));
    EXPECT_FALSE(open(kPlenty, "world 1")->find({0, 0, 0}));
}

TEST_F(SurfaceCacheTest, ADamagedFileIsReplaced) {
    const auto expectEmpty = [&] {
        {
            const auto cache = open();
            EXPECT_FALSE(cache->find({0, 0, 0}));
            cache->put({0, 0, 0}, numberedColumns(1));
        }
        EXPECT_EQ(open()->find({0, 0, 0}), numberedColumns(1));
    };
    store::writeAll(path_, "something else that is no database at all, and longer than a header of one: " +
                               std::string(200, 'x'));
    expectEmpty();
    std::string bytes = store::readAll(path_);
    std::fill(bytes.begin() + 100, bytes.begin() + 4096, 'x');
    store::writeAll(path_, bytes);
    expectEmpty();
    store::writeAll(path_, store::readAll(path_).substr(0, 5000));
    expectEmpty();
    store::writeAll(path_, "");
    expectEmpty();
}

TEST_F(SurfaceCacheTest, AFileWithOtherTablesIsReplaced) {
    store::runSql(path_,
                  "CREATE TABLE origin (text TEXT); INSERT INTO origin VALUES ('2 world 1');"
                  "CREATE TABLE surfaces (other TEXT)");
    const auto cache = open();
    cache->put({0, 0, 0}, numberedColumns(1));
    EXPECT_EQ(cache->find({0, 0, 0}), numberedColumns(1));
}

TEST_F(SurfaceCacheTest, ADamagedRowIsForgotten) {
    open()->put({0, 0, 0}, numberedColumns(1));
    store::runSql(path_, "UPDATE surfaces SET bytes = x'0102030405060708090a'");
    const auto cache = open();
    EXPECT_FALSE(cache->find({0, 0, 0}));
    EXPECT_FALSE(cache->contains({0, 0, 0})) << "so that it is put again";
    cache->put({0, 0, 0}, numberedColumns(1));
    EXPECT_EQ(cache->find({0, 0, 0}), numberedColumns(1));
}

TEST_F(SurfaceCacheTest, ASecondProgramIsRefused) {
    open()->put({0, 0, 0}, numberedColumns(1));
    for (int round = 0; round < 2; ++round) {
        const auto first = open();
        const auto begin = std::chrono::steady_clock::now();
        const auto second = SurfaceCache::open(path_, "world 1", kPlenty);
        ASSERT_FALSE(second);
        EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2)) << "without waiting";
        EXPECT_EQ(second.error().code, base::ErrorCode::Busy);
        EXPECT_THAT(second.error().message, HasSubstr("map.sqlite"));
        EXPECT_THAT(second.error().message, HasSubstr("another program"));
        EXPECT_EQ(second.error().message.find('\n'), std::string::npos);
        const auto other = SurfaceCache::open(path_, "world 2", kPlenty);
        ASSERT_FALSE(other) << "its file is not removed";
        EXPECT_EQ(first->find({0, 0, 0}), numberedColumns(1));
        first->put({0, 0, 0}, numberedColumns(1));
    }
}

TEST_F(SurfaceCacheTest, WhereNothingCanBeWrittenTheErrorSaysWhere) {
    const auto cache = SurfaceCache::open(folder_ / "missing" / "map.sqlite", "world 1", kPlenty);
    ASSERT_FALSE(cache);
    EXPECT_THAT(cache.error().message, HasSubstr("missing/map.sqlite"));
}

TEST_F(SurfaceCacheTest, ThreadsMayUseItAtOnce) {
    const auto cache = open(300000);
    std::vector<std::thread> threads;
    std::atomic<int> wrong = 0;
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([&, t] {
            for (int k = 0; k < 12; ++k) {
                const int number = (t * 5 + k) % 16;
                const auto found = cache->find({number, 0, 0});
                if (found && *found != numberedColumns(number, 3000)) ++wrong;
                if (!found) cache->put({number, 0, 0}, numberedColumns(number, 3000));
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(cache->bytes(), 0);
    EXPECT_LE(fileBytes(), 300000);
}

TEST_F(SurfaceCacheTest, AFileThatIsTooLargeIsReplaced) {
    {
        const auto cache = open();
        for (int k = 0; k < 20; ++k) cache->put({k, 0, 0}, numberedColumns(k, 5000));
    }
    ASSERT_GT(fileBytes(), 300000);
    {
        const auto cache = open(300000);
        EXPECT_EQ(cache->bytes(), 0);
        EXPECT_LE(fileBytes(), 300000);
        cache->put({1, 0, 0}, numberedColumns(1, 5000));
    }
    EXPECT_TRUE(open(300000)->contains({1, 0, 0})) << "one that is small enough is kept";
}

TEST_F(SurfaceCacheTest, SurfacesOfUnknownOriginAreNotTaken) {
    open()->put({0, 0, 0}, numberedColumns(1));
    store::runSql(path_, "DELETE FROM origin");
    {
        const auto cache = open();
        EXPECT_FALSE(cache->contains({0, 0, 0}));
        cache->put({0, 0, 0}, numberedColumns(2));
    }
    EXPECT_EQ(open()->find({0, 0, 0}), numberedColumns(2));
}

TEST_F(SurfaceCacheTest, WhereWritingFailsItStops) {
    if (!base::FileSizeLimit::kWorks) GTEST_SKIP() << "this system has no limit of file sizes";
    const auto cache = open();
    cache->put({0, 0, 0}, numberedColumns(1));
    EXPECT_FALSE(cache->isBroken());
    {
        const base::FileSizeLimit full(static_cast<std::uint64_t>(fileBytes()));
        cache->put({1, 0, 0}, numberedColumns(1, 20000));
    }
    EXPECT_TRUE(cache->isBroken());
    cache->put({2, 0, 0}, {});  // ignored
    EXPECT_FALSE(cache->contains({2, 0, 0}));
}

}  // namespace
}  // namespace terrane::map
