// Expands short command lines: "render --scene cave,ocean --layers 0,3" stands for four runs.
#pragma once

#include "apps/terrane/bench/bench_plan.h"

namespace terrane::app {

// The runs of a line: a command, then pairs of a flag and a word or several words joined by commas; all
// combinations are runs. A repeated flag keeps its first place and its last words, so that equal options give
// equal runs.
std::vector<Cell> expandLine(const std::string& line);

}  // namespace terrane::app
