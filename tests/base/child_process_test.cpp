#include "terrane/base/process.h"

#include <gtest/gtest.h>

#include "terrane/base/files.h"
#include "tests/base/temp_folder.h"
#include "tests/base/wait_until.h"

namespace terrane::base {
namespace {

class ChildProcessTest : public testing::Test {
  protected:
    Result<ChildResult> shell(const std::string& script, std::chrono::milliseconds timeout = kHangs) {
        return runChild({"/bin/sh", "-c", script},
                        {folder.path(), folder / "errors", timeout, {{"TERRANE_TEST", "set"}}});
    }

    TempFolder folder;
};

TEST_F(ChildProcessTest, GivesOutputAndExitCode) {
    const auto end = shell("echo out; echo error >&2; pwd; exit 3");
    ASSERT_TRUE(end);
    EXPECT_EQ(end->exitCode, 3);
    EXPECT_EQ(end->output, "out\n" + std::filesystem::canonical(folder.path()).string() + "\n");
    EXPECT_EQ(*readFile(folder / "errors"), "error\n");
    EXPECT_FALSE(end->timedOut);
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

// A script that records each run in a file and succeeds after `crashes` runs.
std::string crashing(int crashes, const std::string& signal) {
    return "echo >> runs; [ $(wc -l < runs) -gt " + std::to_string(crashes) + " ] || kill -" + signal +
           " $$; echo done";
}

TEST_F(ChildProcessTest, RunsACrashedProgramAgain) {
    const auto run = [&](const std::string& script, int maxRuns) {
        std::filesystem::remove(folder / "runs");
        return runChild({"/bin/sh", "-c", script},
                        {.folder = folder.path(), .errorOutput = folder / "errors", .maxRuns = maxRuns});
    };
    const auto good = run(crashing(2, "SEGV"), 3), bad = run(crashing(3, "ABRT"), 3);
    const auto single = run(crashing(1, "SEGV"), 1), killed = run(crashing(1, "TERM"), 3);
    ASSERT_TRUE(good && bad && single && killed);
    EXPECT_EQ(good->exitCode, 0);
    EXPECT_EQ(good->crashes, 2);
    EXPECT_EQ(good->output, "done\n") << "of the last run alone";
    EXPECT_EQ(bad->exitCode, 128 + 6);
    EXPECT_EQ(bad->crashes, 3);
    EXPECT_EQ(single->exitCode, 128 + 11);
    EXPECT_EQ(killed->exitCode, 128 + 15) << "who asked it to end wants no further run";
    EXPECT_EQ(killed->crashes, 0);
    EXPECT_EQ(shell("kill -9 $$")->crashes, 0);
}

TEST_F(ChildProcessTest, EndsWhatTakesTooLong) {
    const auto end = shell("echo before; exec sleep 1000", std::chrono::milliseconds(20));
    ASSERT_TRUE(end);
    EXPECT_TRUE(end->timedOut);
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

TEST_F(ChildProcessTest, WithoutAProgramNothingStarts) {
    const auto end = runChild({}, {folder.path(), folder / "errors"});
    ASSERT_FALSE(end);
    EXPECT_EQ(end.error().code, ErrorCode::BadInput);
}

}  // namespace
}  // namespace terrane::base
