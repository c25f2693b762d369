#include "apps/terrane/bench/bench_runner.h"

#include <gmock/gmock.h>

#include <fstream>

#include "terrane/base/files.h"
#include "tests/base/temp_folder.h"

namespace terrane::app {
namespace {

using testing::HasSubstr;

const Cell kMeasured{{"info"}, {}};

class BenchRunnerTest : public testing::Test {
  protected:
    // Replaces the program by one that crashes `crashes` times, then prints a result. Returns the last line
    // of the results.
    nlohmann::json measureWith(int crashes) {
        const std::filesystem::path program = folder_ / "program";
        std::ofstream(program) << "#!/bin/sh\necho >> runs\n[ $(wc -l < runs) -gt " << crashes
                               << " ] || kill -SEGV $$\necho '{\"frames\": 3}'\n";
        std::filesystem::permissions(program, std::filesystem::perms::owner_all);
        auto results = ResultFile::create(folder_ / "results.jsonl", {{"runs", 1}}).value();
        BenchRunner runner(program, folder_.path(), {}, results);
        testing::internal::CaptureStderr();
        EXPECT_TRUE(runner.measure(kMeasured, 1));
        messages_ = testing::internal::GetCapturedStderr();
        const std::string text = *base::readFile(folder_ / "results.jsonl");
        return nlohmann::json::parse(text.substr(text.rfind('\n', text.size() - 2) + 1));
    }

    base::TempFolder folder_;
    std::string messages_;
};

TEST_F(BenchRunnerTest, WhatCrashedIsRunAgainAndSaysSo) {
    const nlohmann::json line = measureWith(2);
    ASSERT_TRUE(line.contains("result")) << line;
    EXPECT_EQ(line["result"]["frames"], 3);
    EXPECT_EQ(line["result"]["run"]["crashes"], 2);
    EXPECT_THAT(messages_, HasSubstr("info: crashed 2 times"));
}

TEST_F(BenchRunnerTest, WhatAlwaysCrashesFails) {
    const nlohmann::json line = measureWith(1000);
    EXPECT_FALSE(line.contains("result"));
    EXPECT_THAT(line["failure"].get<std::string>(), HasSubstr("exit code 139"));
    EXPECT_THAT(messages_, HasSubstr("info: crashed 3 times"));
}

TEST_F(BenchRunnerTest, ARunWithoutACrashTellsOfNone) {
    EXPECT_FALSE(measureWith(0)["result"]["run"].contains("crashes"));
    EXPECT_EQ(messages_, "");
}

}  // namespace
}  // namespace terrane::app
