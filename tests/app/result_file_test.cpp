#include "apps/terrane/bench/bench_runner.h"

#include <gmock/gmock.h>

#include <fstream>

#include "terrane/base/files.h"
#include "tests/base/temp_folder.h"

namespace terrane::app {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const json kSettings = {{"renderer", "one"}, {"runs", 3}};
const Cell kCave{{"render", "--scene", "cave"}}, kOcean{{"render", "--scene", "ocean"}};

class ResultFileTest : public testing::Test {
  protected:
    void write(const std::string& text) const { std::ofstream(path) << text; }
    std::string text() const { return *base::readFile(path); }
    // The error of a refused file; empty if it is accepted.
    std::string refusal(const json& settings = kSettings) const {
        const auto file = ResultFile::resume(path, settings);
        return file ? std::string() : file.error().message;
    }

    base::TempFolder folder;
    std::filesystem::path path = folder / "results.jsonl";
};

TEST_F(ResultFileTest, GoesOnWithWhatIsThere) {
    {
        auto file = ResultFile::create(path, kSettings);
        ASSERT_TRUE(file);
        ASSERT_TRUE(file->add(kCave, {{"frame", 1}}));
        ASSERT_TRUE(file->add(kCave, {{"frame", 3}}));
        ASSERT_TRUE(file->addFailure(kOcean, "dry"));
        EXPECT_EQ(file->failureOf(kOcean), "dry");
    }
    auto file = ResultFile::resume(path, kSettings);
    ASSERT_TRUE(file);
    EXPECT_EQ(file->runsOf(kCave), 2);
    EXPECT_EQ(file->failureOf(kOcean), "") << "it is tried again";
    EXPECT_EQ(file->runsOf(kOcean), 0);
    EXPECT_EQ(file->failureCount(), 0u);
    ASSERT_TRUE(file->add(kOcean, {{"frame", 7}}));
    auto again = ResultFile::resume(path, kSettings);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->runsOf(kOcean), 1);
    EXPECT_EQ(again->runsOf(kCave), 2);
}

TEST_F(ResultFileTest, ASuccessTakesAFailureAway) {
    auto file = ResultFile::create(path, kSettings);
    ASSERT_TRUE(file && file->addFailure(kCave, "dark") && file->add(kCave, {{"frame", 1}}));
    EXPECT_EQ(file->failureOf(kCave), "");
}

TEST_F(ResultFileTest, NeverReplacesAFile) {
    write("precious");
    const auto file = ResultFile::create(path, kSettings);
    ASSERT_FALSE(file);
    EXPECT_THAT(file.error().message, HasSubstr("exists already"));
    EXPECT_EQ(text(), "precious");
}

TEST_F(ResultFileTest, ALineThatWasCutShortIsDropped) {
    {
        auto file = ResultFile::create(path, kSettings);
        ASSERT_TRUE(file && file->add(kCave, {{"frame", 1}}) && file->add(kOcean, {{"frame", 2}}));
    }
    const std::string whole = text();
    const std::size_t first = whole.find('\n') + 1, second = whole.find('\n', first) + 1;
    for (std::size_t size = second; size < whole.size(); ++size) {
        write(whole.substr(0, size));
        auto file = ResultFile::resume(path, kSettings);
        ASSERT_TRUE(file) << size;
        EXPECT_EQ(file->runsOf(kCave), 1);
        EXPECT_EQ(file->runsOf(kOcean), 0) << size;
        ASSERT_TRUE(file->add(kOcean, {{"frame", 2}}));
        EXPECT_EQ(text(), whole) << size;
    }
}

TEST_F(ResultFileTest, OtherSettingsAreNotMixedIn) {
    ASSERT_TRUE(ResultFile::create(path, kSettings));
    EXPECT_THAT(refusal({{"renderer", "two"}, {"runs", 3}}),
                HasSubstr("renderer \"one\" there, \"two\" here"));
    EXPECT_THAT(refusal({{"renderer", "one"}, {"runs", 3}, {"size", 1}}), HasSubstr("size null there"));
    EXPECT_THAT(refusal({{"renderer", "one"}}), HasSubstr("other settings"));
    EXPECT_EQ(refusal(), "");
}

TEST_F(ResultFileTest, OtherFilesAreRefused) {
    EXPECT_THAT(refusal(), HasSubstr("cannot be read"));
    for (const char* text : {"", "text", "text\n", "7\n", "{}\n"}) {
        write(text);
        EXPECT_THAT(refusal(), HasSubstr(":1: not results of terrane bench")) << text;
    }
    const std::string head = json{{"settings", kSettings}}.dump() + "\n";
    for (const char* line : {"text", "7", "{}", R"({"cell":7,"result":{}})", R"({"cell":[7],"result":{}})",
                             R"({"cell":["a"]})", ""}) {
        write(head + line + "\n");
        EXPECT_THAT(refusal(), HasSubstr(":2: not a result of terrane bench")) << line;
    }
}

TEST_F(ResultFileTest, TellsWhatCannotBeWritten) {
    auto file = ResultFile::create(folder.path() / "no" / "folder", kSettings);
    ASSERT_FALSE(file);
    EXPECT_THAT(file.error().message, HasSubstr("cannot be written"));
}

}  // namespace
}  // namespace terrane::app
