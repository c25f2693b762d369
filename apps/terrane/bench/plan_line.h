// Command lines in short: "render --scene cave,ocean --layers 0,3" stands for four runs.
#pragma once

#include "apps/terrane/bench/bench_plan.h"

namespace terrane::app {

// The runs that `line` stands for: a command, then flags with a word each, or with several joined by commas,
// of which every combination is a run. A flag that is given again has its last words at its first place, so
// that equal options make equal runs.
std::vector<Cell> expandLine(const std::string& line);

}  // namespace terrane::app
