#include "apps/terrane/bench/bench_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>

namespace terrane::app {
namespace {

using nlohmann::json;

struct Line {
    double slope = 0, intercept = 0;
};

// Least squares; none for less than two different x.
std::optional<Line> lineThrough(const std::vector<std::pair<double, double>>& points) {
    const auto count = static_cast<double>(points.size());
    double x = 0, y = 0, xx = 0, xy = 0;
    for (const auto& [px, py] : points) {
        x += px;
        y += py;
        xx += px * px;
        xy += px * py;
    }
    const double spread = count * xx - x * x;
    if (points.size() < 2 || spread <= 0) return std::nullopt;
    const double slope = (count * xy - x * y) / spread;
    return Line{slope, (y - slope * x) / count};
}

std::optional<double> sumIn(const json& measurement, const std::vector<Value>& values) {
    double sum = 0;
    for (const Value& value : values) {
        const auto part = valueIn(measurement, value);
        if (!part) return std::nullopt;
        sum += *part;
    }
    return sum;
}

std::string withThousands(std::string digits) {
    const std::size_t start = digits.starts_with('-') ? 1 : 0;
    for (std::size_t at = digits.size(); at > start + 3; at -= 3) digits.insert(at - 3, ",");
    return digits;
}

std::string shown(const Entry& entry, const Measurements& measured) {
    if (!entry.compute) return entry.text;
    if (const auto number = numberOf(entry, measured)) return formatFigure(*number);
    for (const Cell& cell : entry.cells)
        if (!measured.find(cell)) return "failed";
    return "–";
}

std::string quotedForCsv(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}

std::string escapedForMarkdown(const std::string& text) {
    std::string escaped;
    for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
    return escaped;
}

std::string markdownRow(const std::vector<std::string>& texts) {
    std::string line = "|";
    for (const std::string& text : texts) line += " " + escapedForMarkdown(text) + " |";
    return line + "\n";
}

std::string csvRow(const std::vector<std::string>& texts) {
    std::string line;
    for (std::size_t k = 0; k < texts.size(); ++k) line += (k > 0 ? "," : "") + quotedForCsv(texts[k]);
    return line + "\n";
}

}  // namespace

Entry textEntry(std::string text) {
    return {std::move(text), {}, nullptr};
}

Entry figureEntry(double figure) {
    return {"", {}, [figure](std::span<const json>) { return std::optional(figure); }};
}

Entry valueEntry(Cell cell, Value value) {
    const auto compute = [value = std::move(value)](std::span<const json> m) { return valueIn(m[0], value); };
    return {"", {std::move(cell)}, compute};
}

Entry shareEntry(Cell part, Cell whole, Value value) {
    const auto compute = [value = std::move(value)](std::span<const json> m) -> std::optional<double> {
        const auto some = valueIn(m[0], value), all = valueIn(m[1], value);
        if (!some || !all || *all == 0) return std::nullopt;
        return 100 * *some / *all;
    };
    return {"", {std::move(part), std::move(whole)}, compute};
}

Entry differenceEntry(Cell cell, Cell than, Value value) {
    const auto compute = [value = std::move(value)](std::span<const json> m) -> std::optional<double> {
        const auto one = valueIn(m[0], value), other = valueIn(m[1], value);
        if (!one || !other) return std::nullopt;
        return *one - *other;
    };
    return {"", {std::move(cell), std::move(than)}, compute};
}

Entry sumEntry(Cell cell, std::vector<Value> values) {
    const auto compute = [values = std::move(values)](std::span<const json> m) -> std::optional<double> {
        return sumIn(m[0], values);
    };
    return {"", {std::move(cell)}, compute};
}

Entry lineEntry(std::vector<Cell> cells, Value x, std::vector<Value> y, LinePart part) {
    const auto compute = [x = std::move(x), y = std::move(y),
                          part](std::span<const json> m) -> std::optional<double> {
        std::vector<std::pair<double, double>> points;
        for (const json& measurement : m) {
            const auto px = valueIn(measurement, x), py = sumIn(measurement, y);
            if (px && py) points.emplace_back(*px, *py);
        }
        const std::optional<Line> line = lineThrough(points);
        if (!line) return std::nullopt;
        return part == LinePart::Slope ? line->slope : line->intercept;
    };
    return {"", std::move(cells), compute};
}

std::vector<Cell> cellsOf(const Table& table) {
    std::vector<Cell> cells;
    std::set<std::string> known;
    const auto add = [&](const Cell& cell) {
        if (known.insert(keyOf(cell)).second) cells.push_back(cell);
    };
    for (const auto& row : table.rows)
        for (const Entry& entry : row) std::ranges::for_each(entry.cells, add);
    if (table.curvePlot)
        for (const Curve& curve : table.curvePlot->curves) add(curve.cell);
    return cells;
}

std::string formatFigure(double value) {
    const double size = std::abs(value);
    if (size < 1000 && value == std::round(value)) return fmt::format("{:.0f}", value + 0.0);
    if (size < 0.0005) return "< 0.001";
    if (size < 0.9995) return fmt::format("{:.3g}", value);
    if (size < 9.995) return fmt::format("{:.2f}", value);
    if (size < 99.95) return fmt::format("{:.1f}", value);
    return withThousands(fmt::format("{:.0f}", value));
}

std::optional<double> numberOf(const Entry& entry, const Measurements& measured) {
    if (!entry.compute) return std::nullopt;
    std::vector<json> results;
    for (const Cell& cell : entry.cells) {
        auto result = measured.find(cell);
        if (!result) return std::nullopt;
        results.push_back(std::move(*result));
    }
    return entry.compute(results);
}

std::string markdownOf(const Table& table, const Measurements& measured) {
    std::string text = markdownRow(table.columns) + "|";
    for (std::size_t k = 0; k < table.columns.size(); ++k) text += "---|";
    text += "\n";
    for (const auto& row : table.rows) {
        assert(row.size() == table.columns.size() && "an entry for each column");
        std::vector<std::string> texts;
        for (const Entry& entry : row) texts.push_back(shown(entry, measured));
        text += markdownRow(texts);
    }
    return text;
}

std::string csvOf(const Table& table, const Measurements& measured) {
    std::string text = csvRow(table.columns);
    for (const auto& row : table.rows) {
        std::vector<std::string> texts;
        for (const Entry& entry : row) {
            const auto number = numberOf(entry, measured);
            texts.push_back(number ? fmt::format("{:.9g}", *number) : entry.text);
        }
        text += csvRow(texts);
    }
    return text;
}

}  // namespace terrane::app
