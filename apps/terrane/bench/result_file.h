// The file of measurements, written while they are made: one JSON value per line. The first line has the
// settings, each other line one run of one cell: its result or its error.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "apps/terrane/bench/bench_plan.h"
#include "terrane/base/result.h"

namespace terrane::app {

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

}  // namespace terrane::app
