// The file that measurements are written to as they are made: a JSON value a line. The first tells the
// settings, each other line is one run of one cell: its result, or why it failed.
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
    // A new file; refused where there is one.
    [[nodiscard]] static base::Result<ResultFile> create(const std::filesystem::path& path,
                                                         const nlohmann::json& settings);
    // Goes on with a file; refused where its settings are others. A last line that was cut short is dropped.
    // What failed is not taken over: it will be tried again.
    [[nodiscard]] static base::Result<ResultFile> resume(const std::filesystem::path& path,
                                                         const nlohmann::json& settings);

    int runsOf(const Cell& cell) const;                  // that have a result
    std::string_view failureOf(const Cell& cell) const;  // empty: none
    std::size_t failureCount() const { return failures_.size(); }

    // On the disk's side of the system when it returns: killing the program loses nothing.
    [[nodiscard]] base::Result<void> add(const Cell& cell, const nlohmann::json& result);
    [[nodiscard]] base::Result<void> addFailure(const Cell& cell, const std::string& reason);

  private:
    explicit ResultFile(std::filesystem::path path) : path_(std::move(path)) {}
    bool takeLine(const nlohmann::json& line);  // false where it is no run
    base::Result<void> append(const nlohmann::json& line) const;

    std::filesystem::path path_;
    std::map<std::string, int> runs_;              // by key
    std::map<std::string, std::string> failures_;  // why a cell has no further runs
};

}  // namespace terrane::app
