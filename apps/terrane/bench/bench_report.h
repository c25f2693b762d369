// The report: all tables as Markdown with what they were measured on, and each as CSV.
#pragma once

#include <filesystem>

#include "apps/terrane/bench/bench_plan.h"
#include "terrane/base/result.h"

namespace terrane::app {

struct ReportInput {
    nlohmann::json about;  // names and values: program, machine, renderer, settings
    double loadAtStart = 0, loadAtEnd = 0;
    bool isQuick = false, drawsPlots = true;
};

// Writes report.md, tables/NAME.csv and, where there is gnuplot, plots/NAME.svg into `folder` (absolute).
[[nodiscard]] base::Result<void> writeReport(const std::filesystem::path& folder,
                                             const std::vector<Table>& tables, const Measurements& measured,
                                             const ReportInput& input);

// "- `render …`: reason" for what failed of a table's measurements; empty where nothing did.
std::string failuresOf(const Table& table, const Measurements& measured);

}  // namespace terrane::app
