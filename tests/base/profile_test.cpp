#include "terrane/base/profile.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "terrane/base/files.h"
#include "terrane/base/job_system.h"
#include "tests/base/temp_folder.h"
#include "tests/base/wait_until.h"

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

// Microseconds, by the clock of zones.
double now() {
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

TEST(Profile, RecordsNestedZones) {
    startTrace();
    double innerLeast = 0, innerMost = 0, outerLeast = 0;
    const double beforeOuter = now();
    {
        TERRANE_ZONE("outer");
        const double beforeInner = now();
        {
            TERRANE_ZONE("inner");
            const double begin = now();
            while (now() - begin < 100) continue;
            innerLeast = now() - begin;
        }
        innerMost = now() - beforeInner;
        outerLeast = now() - beforeInner;
    }
    const double outerMost = now() - beforeOuter;
    stopTrace();
    const ParsedTrace trace = writeAndParse();
    ASSERT_EQ(trace.zones.size(), 2u);
    const nlohmann::json outer = trace.named("outer").at(0);
    const nlohmann::json inner = trace.named("inner").at(0);
    EXPECT_EQ(outer["tid"], inner["tid"]);
    EXPECT_GE(outer["ts"].get<double>(), 0);
    // Times in the file are rounded.
    constexpr double kRounding = 0.01;
    EXPECT_GE(outer["dur"].get<double>(), outerLeast - kRounding);
    EXPECT_LE(outer["dur"].get<double>(), outerMost + kRounding);
    EXPECT_GE(inner["dur"].get<double>(), innerLeast - kRounding);
    EXPECT_LE(inner["dur"].get<double>(), innerMost + kRounding);
    const auto endOf = [](const nlohmann::json& zone) {
        return zone["ts"].get<double>() + zone["dur"].get<double>();
    };
    EXPECT_GE(inner["ts"].get<double>(), outer["ts"].get<double>() - kRounding);
    EXPECT_LE(endOf(inner), endOf(outer) + kRounding);
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
        // The caller works, too: it lets a worker be the first one.
        const auto caller = std::this_thread::get_id();
        std::atomic<bool> hasWorker = false;
        const Result<void> done = parallelFor(jobs, 64, [&](std::size_t) {
            TERRANE_ZONE("index");
            if (std::this_thread::get_id() == caller) return hasWorker.wait(false);
            hasWorker = true;
            hasWorker.notify_all();
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
    std::atomic<int> zones{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 3; ++t) {
        threads.emplace_back([&] {
            while (!stop) {
                { TERRANE_ZONE("busy"); }
                ++zones;
                // Keeps the written files small.
                std::this_thread::sleep_for(std::chrono::microseconds(5));
            }
        });
    }
    for (int round = 0; round < 10; ++round) {
        startTrace();
        EXPECT_TRUE(waitUntil([&, most = zones + 300] { return zones >= most; }));
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
