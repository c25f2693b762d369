// A table of the report as data: what each entry shows and which measurements that needs. Written as Markdown
// and as CSV.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/terrane/bench/measurement.h"

namespace terrane::app {

// One place in a table: a text, or a number from measurements.
struct Entry {
    using Compute = std::function<std::optional<double>(std::span<const nlohmann::json>)>;

    std::string text;
    std::vector<Cell> cells;  // compute gets their measurements in this order
    Compute compute;          // null: the text is all
};

Entry textEntry(std::string text);
Entry figureEntry(double figure);  // a number that is known
Entry valueEntry(Cell cell, Value value);
// In per cent of the same value in `whole`.
Entry shareEntry(Cell part, Cell whole, Value value);
// How much more than the same value in `than`.
Entry differenceEntry(Cell cell, Cell than, Value value);
// The sum of several values of one measurement.
Entry sumEntry(Cell cell, std::vector<Value> values);
// The part of a straight line through the points (x, sum of y) of several measurements, by least squares.
enum class LinePart : std::uint8_t { Slope, Intercept };
Entry lineEntry(std::vector<Cell> cells, Value x, std::vector<Value> y, LinePart part);

enum class PlotKind : std::uint8_t {
    Lines,  // x: the first column, numbers
    Bars,   // a group a row, named by the first columns
};

struct Plot {
    std::string name;  // of its file, after the table's; empty for one that is alone
    PlotKind kind = PlotKind::Lines;
    std::string xLabel, yLabel;
    std::vector<std::size_t> columns = {};  // of the table, a line or bar each
    std::size_t nameColumns = 1;            // of bars
    bool isLogX = false, isLogY = false;
};

// A line of a plot from arrays in a measurement.
struct Curve {
    Cell cell;
    std::string x, y;  // JSON pointers
    std::string label;
    bool isRightAxis = false;
};

struct CurvePlot {
    std::string xLabel, yLabel, rightLabel;
    std::vector<Curve> curves;
};

struct Table {
    std::string name;   // for --only, and of its files
    std::string title;  // with the thesis's number where it has one
    std::string about;  // what is measured, how it is to be read; Markdown
    std::string cut;    // what --quick left out; empty: nothing
    std::vector<std::string> columns;
    std::vector<std::vector<Entry>> rows = {};
    std::vector<Plot> plots = {};
    std::optional<CurvePlot> curvePlot = {};
};

// What its entries and curves need, each cell once, in the order of the table.
std::vector<Cell> cellsOf(const Table& table);

// Three digits and more, of whole numbers all: 0.0123, 1.23, 12.3, 123, 12,345; 7; < 0.001.
std::string formatFigure(double value);

// "–" where the measurement has no such value, "failed" where there is no measurement.
std::string markdownOf(const Table& table, const Measurements& measured);
// Quoted as RFC 4180 has it, lines end with \n; numbers in full, empty where there is none.
std::string csvOf(const Table& table, const Measurements& measured);

// An entry's number, where it has one.
std::optional<double> numberOf(const Entry& entry, const Measurements& measured);

}  // namespace terrane::app
