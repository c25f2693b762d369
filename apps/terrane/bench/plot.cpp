#include "apps/terrane/bench/plot.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>

#include "apps/terrane/bench/child_process.h"
#include "terrane/base/files.h"

namespace terrane::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kStyle =
    "set terminal svg size 900,480 font 'sans-serif,13' background rgb 'white'\n"
    "set key outside top center horizontal\n"
    "set grid ytics linecolor rgb '#dddddd'\n"
    "set border 3\n"
    "set tics nomirror\n"
    "set linetype 1 linecolor rgb '#1f6fb4' linewidth 2 pointtype 7\n"
    "set linetype 2 linecolor rgb '#e08020' linewidth 2 pointtype 5\n"
    "set linetype 3 linecolor rgb '#3a9a50' linewidth 2 pointtype 9\n"
    "set linetype 4 linecolor rgb '#a04a9a' linewidth 2 pointtype 13\n";

// Between single quotes of gnuplot.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
    return result + "'";
}

std::string head(const Table& table, const fs::path& svg, const std::string& x, const std::string& y) {
    return fmt::format("{}set output {}\nset title {} noenhanced\nset xlabel {}\nset ylabel {}\n", kStyle,
                       quoted(svg.string()), quoted(table.title), quoted(x), quoted(y));
}

std::string nameOf(const std::vector<Entry>& row, std::size_t columns) {
    std::string name;
    for (std::size_t k = 0; k < columns; ++k) name += (k > 0 ? ", " : "") + row[k].text;
    return '"' + name + '"';
}

// The first column's numbers, where the points of lines are.
std::string ticsOf(const Table& table) {
    std::string tics;
    for (const auto& row : table.rows) tics += (tics.empty() ? "" : ", ") + row[0].text;
    return tics;
}

struct PlotData {
    std::string block;  // of gnuplot, named $data
    std::size_t numbers = 0;
};

PlotData dataOf(const Table& table, const Plot& plot, const Measurements& measured) {
    PlotData data{"$data << end_of_data\n"};
    for (const auto& row : table.rows) {
        data.block += plot.kind == PlotKind::Bars ? nameOf(row, plot.nameColumns) : row[0].text;
        for (const std::size_t column : plot.columns) {
            const auto number = numberOf(row[column], measured);
            data.block += number ? fmt::format(" {:.6g}", *number) : std::string(" NaN");
            data.numbers += number ? 1 : 0;
        }
        data.block += "\n";
    }
    data.block += "end_of_data\n";
    return data;
}

std::string dataOf(const Curve& curve, const json& measurement, std::size_t index) {
    const json& x = measurement.at(json::json_pointer(curve.x));
    const json& y = measurement.at(json::json_pointer(curve.y));
    std::string block = fmt::format("$data{} << end_of_data\n", index);
    for (std::size_t k = 0; k < std::min(x.size(), y.size()); ++k)
        block += fmt::format("{} {}\n", x[k].dump(), y[k].dump());
    return block + "end_of_data\n";
}

bool hasCurve(const json& measurement, const Curve& curve) {
    return measurement.contains(json::json_pointer(curve.x)) &&
           measurement.contains(json::json_pointer(curve.y));
}

base::Result<void> draw(const std::string& script, const fs::path& path) {
    if (auto written = base::writeFile(path, script); !written) return written;
    const fs::path errors = path.string() + ".log";
    auto end = runChild({"gnuplot", path.string()}, {path.parent_path(), errors, std::chrono::seconds(60)});
    if (!end) return tl::unexpected(end.error());
    if (end->exitCode != 0) return base::fail("gnuplot: {} failed, see {}", path.string(), errors.string());
    std::error_code ignored;
    fs::remove(errors, ignored);
    return {};
}

}  // namespace

std::string plotScript(const Table& table, const Plot& plot, const Measurements& measured,
                       const fs::path& svg) {
    const PlotData data = dataOf(table, plot, measured);
    if (data.numbers == 0) return {};
    std::string script = data.block + head(table, svg, plot.xLabel, plot.yLabel);
    const bool isBars = plot.kind == PlotKind::Bars;
    if (isBars) {
        script +=
            "set style data histogram\nset style histogram clustered gap 1\nset style fill solid 0.9 "
            "noborder\nset xtics scale 0 rotate by -35 font ',10'\nset rmargin 10\nset yrange [*<0:*]\n";
    }
    if (plot.isLogX) script += "set logscale x\nset xtics (" + ticsOf(table) + ")\n";
    if (plot.isLogY) script += "set logscale y\n";
    script += "plot";
    for (std::size_t k = 0; k < plot.columns.size(); ++k) {
        const std::string label = quoted(table.columns[plot.columns[k]]);
        script += fmt::format("{} $data using {}{} title {} noenhanced {}", k > 0 ? "," : "",
                              isBars ? fmt::to_string(k + 2) : fmt::format("1:{}", k + 2),
                              isBars ? ":xtic(1)" : "", label, isBars ? "" : "with linespoints");
    }
    return script + "\n";
}

std::string curveScript(const Table& table, const Measurements& measured, const fs::path& svg) {
    std::string blocks, lines;
    std::size_t count = 0;
    bool hasRight = false;
    for (const Curve& curve : table.curvePlot->curves) {
        const auto measurement = measured.find(curve.cell);
        if (!measurement || !hasCurve(*measurement, curve)) continue;
        blocks += dataOf(curve, *measurement, count);
        lines += fmt::format("{} $data{} using 1:2 {}title {} noenhanced with lines", count > 0 ? "," : "",
                             count, curve.isRightAxis ? "axes x1y2 " : "", quoted(curve.label));
        hasRight = hasRight || curve.isRightAxis;
        ++count;
    }
    if (count == 0) return {};
    std::string script = blocks + head(table, svg, table.curvePlot->xLabel, table.curvePlot->yLabel);
    script += "set yrange [0:*]\n";
    if (hasRight) {
        script += fmt::format("set y2label {}\nset y2tics\nset y2range [0:*]\nset border 11\n",
                              quoted(table.curvePlot->rightLabel));
    }
    return script + "plot" + lines + "\n";
}

bool hasGnuplot() {
    const char* variable = std::getenv("PATH");
    std::istringstream folders(variable ? variable : "/usr/bin:/bin");
    std::string folder;
    while (std::getline(folders, folder, ':'))
        if (::access((folder + "/gnuplot").c_str(), X_OK) == 0) return true;
    return false;
}

base::Result<std::vector<std::string>> drawPlots(const Table& table, const Measurements& measured,
                                                 const fs::path& folder) {
    std::vector<std::string> names;
    const auto add = [&](const std::string& name, const auto& scriptFor) -> base::Result<void> {
        const fs::path svg = folder / (name + ".svg");
        const std::string script = scriptFor(svg);
        if (script.empty()) return {};
        if (auto drawn = draw(script, folder / (name + ".gnuplot")); !drawn) return drawn;
        names.push_back(svg.filename().string());
        return {};
    };
    for (const Plot& plot : table.plots) {
        const auto script = [&](const fs::path& svg) { return plotScript(table, plot, measured, svg); };
        const std::string name = table.name + (plot.name.empty() ? "" : "-" + plot.name);
        if (auto drawn = add(name, script); !drawn) return tl::unexpected(drawn.error());
    }
    if (table.curvePlot) {
        const auto script = [&](const fs::path& svg) { return curveScript(table, measured, svg); };
        if (auto drawn = add(table.name + "-curve", script); !drawn) return tl::unexpected(drawn.error());
    }
    return names;
}

}  // namespace terrane::app
