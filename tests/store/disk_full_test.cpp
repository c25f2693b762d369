// A full file system. Creating a small one requires root.
#include <gmock/gmock.h>
#include <sys/mount.h>

#include "terrane/store/saves/save_check.h"
#include "terrane/store/sqlite/sqlite_store.h"
#include "tests/store/store_fixture.h"

namespace terrane::store {
namespace {

using testing::HasSubstr;

class SmallDisk {
  public:
    SmallDisk() : isMounted_(::mount("tmpfs", folder_.path().c_str(), "tmpfs", 0, "size=4m") == 0) {}
    ~SmallDisk() {
        if (isMounted_) ::umount2(folder_.path().c_str(), MNT_DETACH);
    }
    bool isMounted() const { return isMounted_; }
    std::filesystem::path operator/(const char* name) const { return folder_ / name; }

  private:
    base::TempFolder folder_;
    bool isMounted_;
};

TEST(DiskFull, NothingIsLostAndItWorksAgainWithRoom) {
    const SmallDisk disk;
    if (!disk.isMounted()) GTEST_SKIP() << "a small file system cannot be mounted here";
    const auto registry = testRegistry();
    auto store = SqliteStore::open(disk / "a.sqlite", registry, {.create = kIdentity, .decide = {}},
                                   {.delay = std::chrono::hours(1), .chunks = 1000000});
    ASSERT_TRUE(store) << store.error().message;
    (*store)->save({-1, 0}, numberedChunk(1), Provenance::Edited);
    ASSERT_TRUE((*store)->flush());

    // Leaves less than the 1.2 MB that are saved next.
    writeAll(disk / "other", std::string(3 << 20, 'x'));
    std::mt19937 random(1);
    const auto noise = [&] {
        auto chunk = std::make_shared<world::Chunk>();
        chunk->setBlockEntityData(0, randomBytes(random, 20000));
        return chunk;
    };
    std::vector<world::ChunkPtr> chunks;
    for (int x = 0; x < 60; ++x) (*store)->save({x, 0}, chunks.emplace_back(noise()), Provenance::Edited);
    const auto failed = (*store)->flush();
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().code, base::ErrorCode::OutOfResources);
    EXPECT_THAT(failed.error().message, HasSubstr("a.sqlite: the disk is full"));
    EXPECT_EQ((*store)->status().durable, 1u);
    EXPECT_EQ((*store)->status().waiting, 60u);
    EXPECT_EQ(*(*store)->load({-1, 0}).chunk, *numberedChunk(1));
    EXPECT_EQ(*(*store)->load({30, 0}).chunk, *chunks[30]) << "still there to be loaded";

    std::filesystem::remove(disk / "other");
    const auto again = (*store)->flush();
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ((*store)->status().durable, 61u);
    EXPECT_EQ(*(*store)->load({30, 0}).chunk, *chunks[30]);
    store->reset();
    const auto report = checkSave(disk / "a.sqlite", registry);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_FALSE(report->isDamaged());
    EXPECT_EQ(report->chunks, 61u);
}

}  // namespace
}  // namespace terrane::store
