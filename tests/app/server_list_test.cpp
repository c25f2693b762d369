#include "apps/terrane/window/title/join_dialog.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/base/temp_folder.h"

namespace terrane::app {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class ServerList : public testing::Test {
  protected:
    void remember(const std::string& server, const std::string& name) {
        ASSERT_TRUE(rememberServer(file_, {server, name}));
    }

    base::TempFolder folder_;
    std::filesystem::path file_ = serverListFile(folder_.path() / "data");
};

TEST_F(ServerList, TheLastServerIsFirst) {
    EXPECT_THAT(readServers(file_), IsEmpty());
    remember("a.example:30110", "Ann");
    remember("[::1]:5", "Ann B");
    remember("a.example:30110", "Bob");
    EXPECT_THAT(readServers(file_),
                ElementsAre(PlayedServer{"a.example:30110", "Bob"}, PlayedServer{"[::1]:5", "Ann B"}));
}

TEST_F(ServerList, AServerIsForgotten) {
    remember("a.example:30110", "Ann");
    remember("b.example:30110", "Ann");
    ASSERT_TRUE(removeServer(file_, "a.example:30110"));
    ASSERT_TRUE(removeServer(file_, "c.example:30110"));
    EXPECT_THAT(readServers(file_), ElementsAre(PlayedServer{"b.example:30110", "Ann"}));
}

TEST_F(ServerList, LinesThatNameNoServerAreLeftOut) {
    std::filesystem::create_directories(file_.parent_path());
    std::ofstream(file_) << "\nhost\nhost:0 Ann\nhost:1 \nhost:1 A\x01\nhost:1 Ann\n:::";
    EXPECT_THAT(readServers(file_), ElementsAre(PlayedServer{"host:1", "Ann"}));
}

}  // namespace
}  // namespace terrane::app
