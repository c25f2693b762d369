// A database on a full file system. Creating a small one requires root.
#include <pwd.h>
#include <sys/mount.h>

#include <cstdlib>

#include "tests/store_postgres/world_fixture.h"

namespace terrane::store_postgres {
namespace {

namespace fs = std::filesystem;
using store::Provenance;
using testing::HasSubstr;

// A tablespace on a file system of 24 MB, used by its own database, which takes 8 MB.
class SmallTablespace {
  public:
    SmallTablespace() {
        fs::create_directories(folder_);
        isMounted_ = ::mount("tmpfs", folder_.c_str(), "tmpfs", 0, "size=24m") == 0;
        if (!isMounted_) return;
        fs::create_directory(folder_ / "space");
        const passwd* user = ::getpwnam("postgres");
        for (const fs::path& path : {folder_, folder_ / "space"})
            if (!user || ::chown(path.c_str(), user->pw_uid, user->pw_gid) != 0)
                throw std::runtime_error("no user postgres");
        sharedServer().sql(
            fmt::format("CREATE TABLESPACE small LOCATION '{}'", (folder_ / "space").string()));
        sharedServer().sql("CREATE DATABASE small TABLESPACE small");
    }
    ~SmallTablespace() {
        if (isMounted_) {
            sharedServer().sql("DROP DATABASE small WITH (FORCE)");
            sharedServer().sql("DROP TABLESPACE small");
            ::umount2(folder_.c_str(), MNT_DETACH);
        }
        fs::remove_all(folder_);
    }
    SmallTablespace(const SmallTablespace&) = delete;
    SmallTablespace& operator=(const SmallTablespace&) = delete;

    bool isMounted() const { return isMounted_; }
    fs::path filler() const { return folder_ / "filler"; }
    // Fills the file system up to `free` bytes.
    void fill(std::uintmax_t free) const {
        store::writeAll(filler(), std::string(fs::space(folder_).available - free, 'x'));
    }

  private:
    fs::path folder_ = fs::temp_directory_path() / fmt::format("terrane_small_{}", ::getpid());
    bool isMounted_ = false;
};

class DatabaseDiskFull : public PostgresWorldTest {};

TEST_F(DatabaseDiskFull, NothingIsLostAndItWorksAgainWithRoom) {
    const SmallTablespace space;
    if (!space.isMounted()) GTEST_SKIP() << "a small file system cannot be mounted here";
    address_ = addressOf(urlWith("small")).value();
    auto store = open();
    store->save({-1, 0}, store::numberedChunk(1), Provenance::Edited);
    ASSERT_TRUE(store->flush());

    space.fill(400000);  // less than the 1.2 MB saved next
    std::mt19937 random(1);
    std::vector<world::ChunkPtr> chunks;
    for (int x = 0; x < 60; ++x) {
        auto chunk = std::make_shared<world::Chunk>();
        chunk->setBlockEntityData(0, store::randomBytes(random, 20000));
        store->save({x, 0}, chunks.emplace_back(chunk), Provenance::Edited);
    }
    expectError(errorOf(store->flush()), base::ErrorCode::OutOfResources, address_.shown,
                "the disk of the server is full");
    EXPECT_THAT(store->status().problem, HasSubstr("the disk of the server is full"));
    EXPECT_EQ(store->status().durable, 1u);
    EXPECT_EQ(store->status().waiting, 60u);
    EXPECT_EQ(*store->load({-1, 0}).chunk, *store::numberedChunk(1));
    EXPECT_EQ(*store->load({30, 0}).chunk, *chunks[30]) << "still there to be loaded";
    {
        const auto reader = openReader(address_, registry_);
        ASSERT_TRUE(reader) << reader.error().message;
        EXPECT_EQ((*reader)->load({0, 0}).state, store::LoadedChunk::State::Absent) << "none in part";
    }
    expectError(errorOf(PostgresStore::open(addressOf(urlWith("small") + "&schema=b").value(), registry_,
                                            kCreateWorld)),
                base::ErrorCode::OutOfResources,
                "postgresql://:" + std::to_string(sharedServer().port()) + "/small?schema=b",
                "the disk of the server is full");

    fs::remove(space.filler());
    const auto again = store->flush();
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(store->status().durable, 61u);
    EXPECT_EQ(store->status().problem, "");
    store.reset();
    store = open();
    for (int x = 0; x < 60; ++x) EXPECT_EQ(*store->load({x, 0}).chunk, *chunks[static_cast<std::size_t>(x)]);
}

}  // namespace
}  // namespace terrane::store_postgres
