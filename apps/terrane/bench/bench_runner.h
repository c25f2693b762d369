// Runs the measurements of the plan, each in its own process.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <set>
#include <string_view>

#include "apps/terrane/bench/bench_plan.h"
#include "terrane/base/result.h"

namespace terrane::app {

// The file of measurements, written while they are made: one JSON value per line. The first line has the
// settings, each other line one run of one cell: its result or its error.
class ResultFile {
  public:
    // Creates a file; fails if it exists.
    [[nodiscard]] static base::Result<ResultFile> create(const std::filesystem::path& path,
                                                         const nlohmann::json& settings);
    // Continues a file; fails if its settings differ. Drops a truncated last line. Forgets failures, so that
    // failed cells run again.
    [[nodiscard]] static base::Result<ResultFile> resume(const std::filesystem::path& path,
                                                         const nlohmann::json& settings);

    int runsOf(const Cell& cell) const;                  // runs with a result
    std::string_view failureOf(const Cell& cell) const;  // empty: no failure
    std::size_t failureCount() const { return failures_.size(); }

    // Handed to the operating system on return: killing the program loses nothing.
    [[nodiscard]] base::Result<void> add(const Cell& cell, const nlohmann::json& result);
    [[nodiscard]] base::Result<void> addFailure(const Cell& cell, const std::string& reason);

  private:
    explicit ResultFile(std::filesystem::path path) : path_(std::move(path)) {}
    bool takeLine(const nlohmann::json& line);  // false if it is not a run
    base::Result<void> append(const nlohmann::json& line) const;

    std::filesystem::path path_;
    std::map<std::string, int> runs_;              // by key
    std::map<std::string, std::string> failures_;  // reason for no further runs of a cell
};

class BenchRunner {
  public:
    // `program`: this program's file. `work`: an absolute folder for saves and images of the runs.
    // `drawOptions`: added to each run that draws, but not to its cell. The results outlive the runner.
    BenchRunner(std::filesystem::path program, std::filesystem::path work, Arguments drawOptions,
                ResultFile& results);

    // Runs a cell until it has `runs` results, earlier ones included. Stops at a failed run, which is
    // recorded in the results; an error means that results cannot be written.
    [[nodiscard]] base::Result<void> measure(const Cell& cell, int runs);

  private:
    // The JSON that the run printed.
    base::Result<nlohmann::json> runOnce(const Arguments& arguments) const;
    base::Result<void> prepare(const Cell& cell);

    std::filesystem::path program_, work_;
    Arguments drawOptions_;
    ResultFile& results_;
    std::set<std::string> prepared_;
};

}  // namespace terrane::app
