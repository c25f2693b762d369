// All tables of `terrane bench`, with the thesis's figures beside ours. The thesis: D. Čejchan, Brno 2019,
// tables 6.5 to 6.14, measured on an i7-6700HQ and a GeForce GTX 960M at 1920×1080.
#pragma once

#include "apps/terrane/bench/bench_table.h"

namespace terrane::app {

struct BenchSettings {
    bool isQuick = false;
    std::string size = "1920x1080";
    int viewDistance = 32;
    int farthest = 64;          // of tables that go through view distances
    int frames = 9;             // of a run, beside the first; the median counts
    int runs = 3;               // of each cell; the median counts
    int maxSamples = 4;         // of the graphics driver
    bool isSoftware = true;     // drawn by the processor
    double flightSeconds = 20;  // of the flights
};

// What is cut for --quick.
BenchSettings quickSettings();

std::vector<Table> planTables(const BenchSettings& settings);

// Parts of the plan: the thesis's tables about the world and about frames, and ours.
Table goalTable(const BenchSettings& settings);
std::vector<Table> worldTables(const BenchSettings& settings);
std::vector<Table> frameTables(const BenchSettings& settings);
std::vector<Table> ownTables(const BenchSettings& settings);
std::vector<Table> growthTables(const BenchSettings& settings);

}  // namespace terrane::app
