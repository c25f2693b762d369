#include "terrane/base/child_process.h"

#include <gtest/gtest.h>

#include "terrane/base/files.h"
#include "tests/base/temp_folder.h"

namespace terrane::base {
namespace {

class ChildProcessTest : public testing::Test {
  protected:
    Result<ChildEnd> shell(const std::string& script, std::chrono::seconds atMost = std::chrono::minutes(1)) {
        return runChild({"/bin/sh", "-c", script},
                        {folder.path(), folder / "errors", atMost, {{"TERRANE_TEST", "set"}}});
    }

    TempFolder folder;
};

TEST_F(ChildProcessTest, GivesOutputAndExitCode) {
    const auto end = shell("echo out; echo error >&2; pwd; exit 3");
    ASSERT_TRUE(end);
    EXPECT_EQ(end->exitCode, 3);
    EXPECT_EQ(end->output, "out\n" + std::filesystem::canonical(folder.path()).string() + "\n");
    EXPECT_EQ(*readFile(folder / "errors"), "error\n");
    EXPECT_FALSE(end->tookTooLong);
    EXPECT_GT(end->seconds, 0);
}

TEST_F(ChildProcessTest, TakesMuchOutput) {
    const auto end = shell("i=0; while [ $i -lt 20000 ]; do echo 0123456789; i=$((i+1)); done");
    ASSERT_TRUE(end);
    EXPECT_EQ(end->output.size(), 220000u);
}

TEST_F(ChildProcessTest, TellsSignals) {
    const auto end = shell("kill -9 $$");
    ASSERT_TRUE(end);
    EXPECT_EQ(end->exitCode, 128 + 9);
}

TEST_F(ChildProcessTest, EndsWhatTakesTooLong) {
    const auto end = shell("echo before; exec sleep 1000", std::chrono::seconds(1));
    ASSERT_TRUE(end);
    EXPECT_TRUE(end->tookTooLong);
    EXPECT_NE(end->exitCode, 0);
}

TEST_F(ChildProcessTest, AProgramThatIsNotThereDoesNotStart) {
    const auto end = runChild({"/nonexistent/program"}, {folder.path(), folder / "errors"});
    ASSERT_TRUE(end);
    EXPECT_EQ(end->exitCode, 127);
}

TEST_F(ChildProcessTest, ReadsNothingAndHasTheVariables) {
    const auto end = shell("cat; echo $TERRANE_TEST");
    ASSERT_TRUE(end);
    EXPECT_EQ(end->output, "set\n");
}

}  // namespace
}  // namespace terrane::base
