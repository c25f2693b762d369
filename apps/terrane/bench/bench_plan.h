// All measurements of `terrane bench`: command lines of the program, grouped by the tables that
// tools/bench_report makes from them. tests/app/bench_test.py checks that groups and tables match.
#pragma once

#include <string>
#include <vector>

namespace terrane::app {

using Arguments = std::vector<std::string>;

// One run of the program. Equal arguments are one measurement, even in several groups.
struct Cell {
    Arguments arguments;
    Arguments before = {};  // a run that precedes it once and is not measured; empty: none
};

// The command line; identifies the measurement.
std::string keyOf(const Cell& cell);

struct CellGroup {
    std::string name;
    std::vector<Cell> cells;
};

struct BenchSettings {
    bool isQuick = false;
    std::string size = "1920x1080";
    int viewDistance = 32;
    int farthest = 64;          // of groups that vary the view distance
    int frames = 9;             // per run, without the first; the median counts
    int runs = 3;               // per cell; the median counts
    int maxSamples = 4;         // supported by the graphics driver
    bool isSoftware = true;     // drawn by the CPU
    double flightSeconds = 20;  // per flight
};

// Fewer and smaller measurements, for --quick.
BenchSettings quickSettings();

std::vector<CellGroup> planGroups(const BenchSettings& settings);

// Each cell once, in the order of the groups.
std::vector<Cell> uniqueCells(const std::vector<CellGroup>& groups);

// Expands short command lines: "render --scene cave,ocean --layers 0,3" stands for four runs.
// The runs of a line: a command, then pairs of a flag and a word or several words joined by commas; all
// combinations are runs. A repeated flag keeps its first place and its last words, so that equal options give
// equal runs.
std::vector<Cell> expandLine(const std::string& line);

}  // namespace terrane::app
