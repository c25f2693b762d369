#include "apps/terrane/window/game/watch.h"

#include <gtest/gtest.h>

#include "terrane/base/files.h"
#include "tests/base/temp_folder.h"

namespace terrane::app {
namespace {

using FileTime = std::filesystem::file_time_type;
using namespace std::chrono_literals;

class ContentWatchTest : public testing::Test {
  protected:
    ContentWatchTest() {
        pack_.where = folder_.path().string();
        save("blocks.toml", "# one");
        std::filesystem::last_write_time(folder_ / "blocks.toml", savedAt_);
    }
    void save(const char* name, const char* text) { ASSERT_TRUE(base::writeFile(folder_ / name, text)); }
    bool look(ContentWatch& watch) { return watch.hasChanged(now_ += 600ms); }

    base::TempFolder folder_;
    pack::Pack pack_;
    const FileTime savedAt_ = FileTime::clock::now() - 1h;
    std::chrono::steady_clock::time_point now_ = std::chrono::steady_clock::now();
};

TEST_F(ContentWatchTest, ReportsAChangeOnceItIsStable) {
    ContentWatch watch({pack_}, savedAt_ + 1s);
    EXPECT_FALSE(look(watch));
    save("blocks.toml", "# two");
    EXPECT_FALSE(look(watch)) << "it may still be written";
    EXPECT_TRUE(look(watch));
    EXPECT_FALSE(look(watch));
    save("unrelated.bak", "");
    EXPECT_FALSE(look(watch));
    EXPECT_FALSE(look(watch));
}

TEST_F(ContentWatchTest, ReportsWhatWasSavedWhileThePacksWereRead) {
    ContentWatch watch({pack_}, savedAt_ - 1s);
    EXPECT_TRUE(look(watch));
    EXPECT_FALSE(look(watch));
}

}  // namespace
}  // namespace terrane::app
