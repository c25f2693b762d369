#include "terrane/base/log.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/base/failing_memory.h"

namespace terrane::base {
namespace {

class LogTest : public testing::Test {
  protected:
    ~LogTest() override { setLogLevel(LogLevel::Info); }
};

TEST_F(LogTest, WritesShortLinesToStandardError) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    logInfo("{} chunks", 12);
    logWarning("no file {}", "a.toml");
    logError("stopped");
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              "terrane: 12 chunks\nterrane: warning: no file a.toml\nterrane: error: stopped\n");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST_F(LogTest, WithoutMemoryALineSaysSo) {
    logInfo("the log is there");
    if (!FailingMemory::isPossible()) GTEST_SKIP() << "memory does not fail under this sanitizer";
    const std::string longText(5000, 'x');
    testing::internal::CaptureStderr();
    {
        const FailingMemory memory(0);
        EXPECT_NO_THROW(logError("{}", longText));
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "terrane: no memory for a message\n");
}

TEST_F(LogTest, LeavesOutWhatIsBelowTheLevel) {
    testing::internal::CaptureStderr();
    setLogLevel(LogLevel::Warning);
    logInfo("a");
    logWarning("b");
    setLogLevel(LogLevel::Error);
    logWarning("c");
    logError("d");
    setLogLevel(LogLevel::Silent);
    logError("e");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "terrane: warning: b\nterrane: error: d\n");
}

TEST_F(LogTest, TakesBracesInArgumentsAsTheyAre) {
    testing::internal::CaptureStderr();
    logInfo("{}", "{} %v {0}");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "terrane: {} %v {0}\n");
}

TEST_F(LogTest, KeepsLinesOfManyThreadsWhole) {
    testing::internal::CaptureStderr();
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([] {
            for (int i = 0; i < 100; ++i) logInfo("a line of some length");
        });
    }
    for (std::thread& thread : threads) thread.join();
    std::istringstream text(testing::internal::GetCapturedStderr());
    int lineCount = 0;
    for (std::string line; std::getline(text, line); ++lineCount) {
        EXPECT_EQ(line, "terrane: a line of some length");
    }
    EXPECT_EQ(lineCount, 400);
}

}  // namespace
}  // namespace terrane::base
