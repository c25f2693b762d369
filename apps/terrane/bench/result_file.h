// The file that measurements are written to as they are made: a JSON value a line. The first tells the
// settings, each other line is one run of one cell.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/terrane/bench/measurement.h"
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

    const Measurements& measured() const { return measured_; }

    // On the disk's side of the system when it returns: killing the program loses nothing.
    [[nodiscard]] base::Result<void> add(const Cell& cell, const nlohmann::json& result);
    [[nodiscard]] base::Result<void> addFailure(const Cell& cell, const std::string& reason);

  private:
    explicit ResultFile(std::filesystem::path path) : path_(std::move(path)) {}
    base::Result<void> append(const nlohmann::json& line) const;

    std::filesystem::path path_;
    Measurements measured_;
};

}  // namespace terrane::app
