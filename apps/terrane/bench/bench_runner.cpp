#include "apps/terrane/bench/bench_runner.h"

#include <fstream>
#include <sstream>

#include "terrane/base/files.h"
#include "terrane/base/log.h"
#include "terrane/base/machine.h"
#include "terrane/base/process.h"

namespace terrane::app {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* kSettings = "settings";

// Describes the first difference, for error messages.
std::string difference(const json& there, const json& here) {
    for (const auto& [key, value] : here.items()) {
        const json other = there.contains(key) ? there[key] : json();
        if (other != value) return fmt::format("{} {} there, {} here", key, other.dump(), value.dump());
    }
    return "settings that this program does not know";
}

}  // namespace

base::Result<ResultFile> ResultFile::create(const fs::path& path, const json& settings) {
    std::error_code ignored;
    if (fs::exists(path, ignored)) {
        return base::fail("{}: exists already; continue it with --resume, or name another folder",
                          path.string());
    }
    ResultFile file(path);
    TERRANE_TRY(file.append({{kSettings, settings}}));
    return file;
}

base::Result<ResultFile> ResultFile::resume(const fs::path& path, const json& settings) {
    auto text = TERRANE_TRY(base::readFile(path));
    const std::size_t whole = text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1;
    ResultFile file(path);
    std::istringstream lines(text.substr(0, whole));
    std::string line;
    for (std::size_t number = 1; std::getline(lines, line); ++number) {
        const json value = json::parse(line, nullptr, false);
        if (number == 1) {
            if (!value.is_object() || !value.contains(kSettings))
                return base::fail("{}:1: not results of terrane bench", path.string());
            if (value[kSettings] != settings)
                return base::fail("{}: results of other settings: {}", path.string(),
                                  difference(value[kSettings], settings));
        } else if (!file.takeLine(value)) {
            return base::fail("{}:{}: not a result of terrane bench", path.string(), number);
        }
    }
    if (whole == 0) return base::fail("{}:1: not results of terrane bench", path.string());
    std::error_code error;
    if (whole < text.size()) fs::resize_file(path, whole, error);
    if (error) return base::fail("{}: cannot be written: {}", path.string(), error.message());
    return file;
}

bool ResultFile::takeLine(const json& line) {
    if (!line.is_object() || !line.contains("cell") || !line["cell"].is_array()) return false;
    Cell cell;
    for (const json& argument : line["cell"]) {
        if (!argument.is_string()) return false;
        cell.arguments.push_back(argument.get<std::string>());
    }
    if (line.contains("result")) ++runs_[keyOf(cell)];
    return line.contains("result") || line.contains("failure");
}

int ResultFile::runsOf(const Cell& cell) const {
    const auto found = runs_.find(keyOf(cell));
    return found == runs_.end() ? 0 : found->second;
}

std::string_view ResultFile::failureOf(const Cell& cell) const {
    const auto found = failures_.find(keyOf(cell));
    return found == failures_.end() ? std::string_view() : found->second;
}

base::Result<void> ResultFile::add(const Cell& cell, const json& result) {
    failures_.erase(keyOf(cell));
    ++runs_[keyOf(cell)];
    return append({{"cell", cell.arguments}, {"result", result}});
}

base::Result<void> ResultFile::addFailure(const Cell& cell, const std::string& reason) {
    failures_[keyOf(cell)] = reason;
    return append({{"cell", cell.arguments}, {"failure", reason}});
}

base::Result<void> ResultFile::append(const json& line) const {
    std::ofstream out(path_, std::ios::app);
    // A driver may report invalid UTF-8.
    out << line.dump(-1, ' ', false, json::error_handler_t::replace) << '\n';
    out.close();
    if (!out) return base::fail("{}: cannot be written", path_.string());
    return {};
}

namespace {

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
                                     .timeout = kLongestRun,
                                     // An installed program keeps its saves in the data folder.
                                     .environment = {{"XDG_DATA_HOME", work_.string()}},
                                     .maxRuns = kMostRuns};
    const double load = base::loadAverage();
    const auto end = TERRANE_TRY(base::runChild(command, options));
    if (end.crashes > 0) base::logWarning("{}: crashed {} times", keyOf({arguments}), end.crashes);
    if (end.timedOut) return base::fail("took longer than {} s", kLongestRun.count());
    if (end.exitCode != 0) return base::fail("exit code {}: {}", end.exitCode, lastLine(options.errorOutput));
    json result = json::parse(end.output, nullptr, false);
    if (!result.is_object()) return base::fail("printed no JSON object");
    result["run"] = {{"seconds", end.seconds}, {"processor_seconds", end.cpuSeconds}, {"load_average", load}};
    if (end.crashes > 0) result["run"]["crashes"] = end.crashes;
    return result;
}

}  // namespace terrane::app
