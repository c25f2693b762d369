// Plots of tables as SVG, drawn by gnuplot. Each keeps its script beside it, with the data in it.
#pragma once

#include <filesystem>

#include "apps/terrane/bench/bench_table.h"
#include "terrane/base/result.h"

namespace terrane::app {

// What gnuplot draws into `svg`; empty where there is nothing to draw.
std::string plotScript(const Table& table, const Plot& plot, const Measurements& measured,
                       const std::filesystem::path& svg);
std::string curveScript(const Table& table, const Measurements& measured, const std::filesystem::path& svg);

bool hasGnuplot();

// The plots of a table that could be drawn, in `folder` (absolute); needs gnuplot.
[[nodiscard]] base::Result<std::vector<std::string>> drawPlots(const Table& table,
                                                               const Measurements& measured,
                                                               const std::filesystem::path& folder);

}  // namespace terrane::app
