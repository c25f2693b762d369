#include "apps/terrane/bench/bench_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/terrane/bench/plot.h"
#include "terrane/base/files.h"

namespace terrane::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Of all runs: the least and the greatest load average before one, and seconds of all.
std::string loadLines(const Measurements& measured, const ReportInput& input) {
    double least = 1e9, most = 0, seconds = 0, processor = 0;
    std::size_t count = 0;
    for (const auto& [key, runs] : measured.runs) {
        for (const json& run : runs) {
            const double load = valueIn(run, {"/run/load_average"}).value_or(0);
            least = std::min(least, load);
            most = std::max(most, load);
            seconds += valueIn(run, {"/run/seconds"}).value_or(0);
            processor += valueIn(run, {"/run/processor_seconds"}).value_or(0);
            ++count;
        }
    }
    std::string text = fmt::format("| load average at the start, at the end | {:.2f}, {:.2f} |\n",
                                   input.loadAtStart, input.loadAtEnd);
    if (count > 0) {
        text += fmt::format("| load average before each run | {:.2f} to {:.2f} |\n", least, most);
        text += fmt::format("| runs | {}, {:.0f} s, {:.0f} s of processors |\n", count, seconds, processor);
    }
    return text;
}

std::string headOf(const Measurements& measured, const ReportInput& input) {
    std::string text = fmt::format("# Measurements{}\n\n| | |\n|---|---|\n", input.isQuick ? ", quick" : "");
    for (const auto& [name, value] : input.about.items()) {
        std::string spaced = name;
        std::ranges::replace(spaced, '_', ' ');
        text +=
            fmt::format("| {} | {} |\n", spaced, value.is_string() ? value.get<std::string>() : value.dump());
    }
    text += loadLines(measured, input);
    text +=
        "\nEach measurement is a run of the program by itself; figures are medians of its runs, times of "
        "frames "
        "medians of the frames of a run, after a first one. The frames of the thesis's tables are drawn with "
        "`--preset thesis` and greedy merging. A load average above that of one program that uses all "
        "processors means that others ran, too: times are then too long.\n\nThe thesis: D. Čejchan, Brno "
        "2019; "
        "i7-6700HQ, GeForce GTX 960M, 1920×1080, view distance 32 where a table says nothing else. Its "
        "frames "
        "a second are counted on a screen.\n";
    if (!input.drawsPlots) text += "\nNo plots: gnuplot is missing.\n";
    return text;
}

std::string sectionOf(const Table& table, const Measurements& measured, bool isQuick,
                      const std::vector<std::string>& plots) {
    std::string text = fmt::format("\n## {}\n\n{}\n\n", table.title, table.about);
    if (isQuick && !table.cut.empty()) text += fmt::format("Cut for `--quick`: {}.\n\n", table.cut);
    text += markdownOf(table, measured);
    for (const std::string& plot : plots) text += fmt::format("\n![{}](plots/{})\n", table.title, plot);
    const std::string failures = failuresOf(table, measured);
    if (!failures.empty()) text += "\nWhat failed:\n\n" + failures;
    return text;
}

}  // namespace

std::string failuresOf(const Table& table, const Measurements& measured) {
    std::string text;
    for (const Cell& cell : cellsOf(table)) {
        const std::string_view reason = measured.failureOf(cell);
        if (!reason.empty()) text += fmt::format("- `{}`: {}\n", keyOf(cell), reason);
    }
    return text;
}

base::Result<void> writeReport(const fs::path& folder, const std::vector<Table>& tables,
                               const Measurements& measured, const ReportInput& input) {
    for (const char* part : {"tables", "plots"}) {
        std::error_code error;
        fs::create_directories(folder / part, error);
        if (error) return base::fail("{}: cannot be made: {}", (folder / part).string(), error.message());
    }
    std::string report = headOf(measured, input);
    for (const Table& table : tables) {
        const fs::path csv = folder / "tables" / (table.name + ".csv");
        if (auto written = base::writeFile(csv, csvOf(table, measured)); !written) return written;
        std::vector<std::string> plots;
        if (input.drawsPlots) {
            auto drawn = drawPlots(table, measured, folder / "plots");
            if (!drawn) return tl::unexpected(drawn.error());
            plots = std::move(*drawn);
        }
        report += sectionOf(table, measured, input.isQuick, plots);
    }
    return base::writeFile(folder / "report.md", report);
}

}  // namespace terrane::app
