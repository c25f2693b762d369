#include "terrane/base/profile.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "temp_folder.h"
#include "terrane/base/files.h"
#include "terrane/base/job_system.h"

namespace terrane::base {
namespace {

struct ParsedTrace {
    std::vector<nlohmann::json> zones;
    std::map<int, std::string> threadNames;

    [[nodiscard]] std::vector<nlohmann::json> named(const std::string& name) const {
        std::vector<nlohmann::json> found;
        for (const nlohmann::json& zone : zones) {
            if (zone["name"] == name) found.push_back(zone);
        }
        return found;
    }
};

ParsedTrace writeAndParse() {
    const TempFolder folder;
    EXPECT_TRUE(writeTrace(folder / "trace.json"));
    const nlohmann::json json = nlohmann::json::parse(readFile(folder / "trace.json").value());
    ParsedTrace trace;
    for (const nlohmann::json& event : json["traceEvents"]) {
        EXPECT_EQ(event["pid"], 1);
        if (event["ph"] == "X") {
            trace.zones.push_back(event);
        } else if (event["name"] == "thread_name") {
            trace.threadNames[event["tid"]] = event["args"]["name"];
        }
    }
    return trace;
}

TEST(Profile, RecordsNestedZones) {
    startTrace();
    {
        TERRANE_ZONE("outer");
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        {
            TERRANE_ZONE("inner");
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    }
    stopTrace();
    const ParsedTrace trace = writeAndParse();
    ASSERT_EQ(trace.zones.size(), 2u);
    const nlohmann::json outer = trace.named("outer").at(0);
    const nlohmann::json inner = trace.named("inner").at(0);
    EXPECT_EQ(outer["tid"], inner["tid"]);
    EXPECT_GE(outer["ts"].get<double>(), 0);
    EXPECT_GE(outer["dur"].get<double>(), 4000) << "microseconds";
    EXPECT_GE(inner["dur"].get<double>(), 2000);
    EXPECT_GE(inner["ts"].get<double>(), outer["ts"].get<double>() + 2000);
    EXPECT_LE(inner["dur"].get<double>(), outer["dur"].get<double>() - 2000);
}

TEST(Profile, RecordsNothingWhileNoTraceRuns) {
    { TERRANE_ZONE("before"); }
    startTrace();
    { TERRANE_ZONE("during"); }
    stopTrace();
    { TERRANE_ZONE("after"); }
    const ParsedTrace trace = writeAndParse();
    ASSERT_EQ(trace.zones.size(), 1u);
    EXPECT_EQ(trace.zones[0]["name"], "during");
}

TEST(Profile, LeavesOutZonesThatCrossTheEdgesOfATrace) {
    {
        TERRANE_ZONE("begins before");
        startTrace();
    }
    {
        TERRANE_ZONE("ends after");
        stopTrace();
    }
    {
        startTrace();
        TERRANE_ZONE("of the trace before");
        startTrace();
    }
    stopTrace();
    EXPECT_TRUE(writeAndParse().zones.empty());
}

TEST(Profile, StartForgetsThePreviousTrace) {
    startTrace();
    { TERRANE_ZONE("first"); }
    startTrace();
    { TERRANE_ZONE("second"); }
    stopTrace();
    const ParsedTrace trace = writeAndParse();
    EXPECT_EQ(trace.named("first").size(), 0u);
    EXPECT_EQ(trace.named("second").size(), 1u);
}

TEST(Profile, KeepsZonesOfThreadsThatEnded) {
    startTrace();
    std::thread([] {
        setThreadName("short \"life\"\n");
        TERRANE_ZONE("work");
    }).join();
    stopTrace();
    const ParsedTrace trace = writeAndParse();
    const std::vector<nlohmann::json> work = trace.named("work");
    ASSERT_EQ(work.size(), 1u);
    EXPECT_EQ(trace.threadNames.at(work[0]["tid"]), "short \"life\"\n");
}

TEST(Profile, JobSystemNamesItsWorkers) {
    startTrace();
    {
        JobSystem jobs(2);
        const Result<void> done = parallelFor(jobs, 64, [](std::size_t) {
            TERRANE_ZONE("index");
            std::this_thread::sleep_for(std::chrono::microseconds(200));
        });
        EXPECT_TRUE(done);
    }
    stopTrace();
    const ParsedTrace trace = writeAndParse();
    EXPECT_EQ(trace.named("index").size(), 64u);
    std::map<std::string, int> zonesByThread;
    for (const nlohmann::json& zone : trace.zones) {
        const auto found = trace.threadNames.find(zone["tid"]);
        if (found != trace.threadNames.end()) zonesByThread[found->second] += 1;
    }
    EXPECT_GT(zonesByThread["worker 1"] + zonesByThread["worker 2"], 0);
}

TEST(Profile, KeepsMoreZonesThanOneBlockHolds) {
    startTrace();
    for (int i = 0; i < 10000; ++i) {
        TERRANE_ZONE("many");
    }
    stopTrace();
    EXPECT_EQ(writeAndParse().zones.size(), 10000u);
}

TEST(Profile, DropsWhatDoesNotFitAndSaysSo) {
    constexpr int kKept = 1048576;
    startTrace();
    for (int i = 0; i < kKept + 5; ++i) {
        TERRANE_ZONE("z");
    }
    stopTrace();
    const TempFolder folder;
    testing::internal::CaptureStderr();
    EXPECT_TRUE(writeTrace(folder / "trace.json"));
    const std::string text = testing::internal::GetCapturedStderr();
    EXPECT_NE(text.find("5 zones did not fit"), std::string::npos) << text;
}

TEST(Profile, MayBeStartedAndWrittenWhileThreadsRecord) {
    std::atomic<bool> stop{false};
    std::vector<std::thread> threads;
    for (int t = 0; t < 3; ++t) {
        threads.emplace_back([&] {
            while (!stop) {
                { TERRANE_ZONE("busy"); }
                // Keeps the written files small; a trace still takes in hundreds of zones of each thread.
                std::this_thread::sleep_for(std::chrono::microseconds(5));
            }
        });
    }
    for (int round = 0; round < 10; ++round) {
        startTrace();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (round % 2 == 0) stopTrace();
        for (const nlohmann::json& zone : writeAndParse().zones) EXPECT_EQ(zone["name"], "busy");
    }
    stop = true;
    for (std::thread& thread : threads) thread.join();
    stopTrace();
}

TEST(Profile, ReportsAFileThatCannotBeWritten) {
    startTrace();  // an empty one
    stopTrace();
    const TempFolder folder;
    const Result<void> result = writeTrace(folder / "missing" / "trace.json");
    ASSERT_FALSE(result);
    EXPECT_NE(result.error().message.find("missing/trace.json: cannot be written"), std::string::npos);
}

}  // namespace
}  // namespace terrane::base
