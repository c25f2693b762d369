// All measurements of `terrane bench`: command lines of the program, in groups with the names of the tables
// that tools/bench_report makes from them. tests/app/bench_test.py compares the two.
#pragma once

#include <string>
#include <vector>

namespace terrane::app {

using Arguments = std::vector<std::string>;

// One run of the program. Equal arguments are one measurement, whichever groups have it.
struct Cell {
    Arguments arguments;
    Arguments before = {};  // a run that must be made once before and is not measured; empty: none
};

// As on a command line. The name of a measurement.
std::string keyOf(const Cell& cell);

struct CellGroup {
    std::string name;
    std::vector<Cell> cells;
};

struct BenchSettings {
    bool isQuick = false;
    std::string size = "1920x1080";
    int viewDistance = 32;
    int farthest = 64;          // of groups that go through view distances
    int frames = 9;             // of a run, beside the first; the median counts
    int runs = 3;               // of each cell; the median counts
    int maxSamples = 4;         // of the graphics driver
    bool isSoftware = true;     // drawn by the processor
    double flightSeconds = 20;  // of the flights
};

// Less of everything, for --quick.
BenchSettings quickSettings();

std::vector<CellGroup> planGroups(const BenchSettings& settings);

// Each cell once, in the order of the groups.
std::vector<Cell> uniqueCells(const std::vector<CellGroup>& groups);

}  // namespace terrane::app
