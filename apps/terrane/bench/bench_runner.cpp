#include "apps/terrane/bench/bench_runner.h"

#include <sstream>

#include "terrane/base/child_process.h"
#include "terrane/base/files.h"
#include "terrane/base/log.h"
#include "terrane/base/machine.h"

namespace terrane::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::chrono::seconds kLongestRun{1800};  // V=64 at 1920×1080 takes some minutes in software
constexpr int kMostRuns = 3;                       // tries of a crashing run: Mesa 22.3 crashes rarely

// The last message of a program, without the prefix of its errors.
std::string lastLine(const fs::path& file) {
    const auto text = base::readFile(file);
    std::istringstream lines(text ? *text : "");
    std::string line, last;
    while (std::getline(lines, line))
        if (!line.empty()) last = line;
    constexpr std::string_view kPrefix = "terrane: error: ";
    return last.starts_with(kPrefix) ? last.substr(kPrefix.size()) : last;
}

}  // namespace

BenchRunner::BenchRunner(fs::path program, fs::path work, Arguments drawOptions, ResultFile& results)
    : program_(std::move(program)),
      work_(std::move(work)),
      drawOptions_(std::move(drawOptions)),
      results_(results) {}

base::Result<void> BenchRunner::measure(const Cell& cell, int runs) {
    const int there = results_.runsOf(cell);
    if (there >= runs) return {};
    if (auto ready = prepare(cell); !ready)
        return results_.addFailure(cell, "before it: " + ready.error().message);
    for (int run = there; run < runs; ++run) {
        const auto result = runOnce(cell.arguments);
        const auto kept =
            result ? results_.add(cell, *result) : results_.addFailure(cell, result.error().message);
        if (!kept || !result) return kept;
    }
    return {};
}

base::Result<void> BenchRunner::prepare(const Cell& cell) {
    const std::string key = keyOf({cell.before});
    if (cell.before.empty() || prepared_.contains(key)) return {};
    (void)TERRANE_TRY(runOnce(cell.before));
    prepared_.insert(key);
    return {};
}

base::Result<json> BenchRunner::runOnce(const Arguments& arguments) const {
    Arguments command{program_.string()};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const bool draws = arguments[0] == "render" || arguments[0] == "flight-bench";
    if (draws) command.insert(command.end(), drawOptions_.begin(), drawOptions_.end());
    if (arguments[0] == "render") command.insert(command.end(), {"--output", "picture.png"});
    if (arguments[0] != "bench") command.push_back("--json");
    const base::ChildOptions options{.folder = work_,
                                     .errorOutput = work_ / "messages.txt",
                                     .atMost = kLongestRun,
                                     // An installed program keeps its saves in the data folder.
                                     .environment = {{"XDG_DATA_HOME", work_.string()}},
                                     .mostRuns = kMostRuns};
    const double load = base::loadAverage();
    const auto end = TERRANE_TRY(base::runChild(command, options));
    if (end.crashes > 0) base::logWarning("{}: crashed {} times", keyOf({arguments}), end.crashes);
    if (end.tookTooLong) return base::fail("took longer than {} s", kLongestRun.count());
    if (end.exitCode != 0) return base::fail("exit code {}: {}", end.exitCode, lastLine(options.errorOutput));
    json result = json::parse(end.output, nullptr, false);
    if (!result.is_object()) return base::fail("printed no JSON object");
    result["run"] = {{"seconds", end.seconds}, {"processor_seconds", end.cpuSeconds}, {"load_average", load}};
    if (end.crashes > 0) result["run"]["crashes"] = end.crashes;
    return result;
}

}  // namespace terrane::app
