// Runs the measurements of the plan, each in its own process.
#pragma once

#include <set>

#include "apps/terrane/bench/bench_plan.h"
#include "apps/terrane/bench/result_file.h"

namespace terrane::app {

class BenchRunner {
  public:
    // `program`: this program's file. `work`: an absolute folder for saves and images of the runs.
    // `drawOptions`: added to each run that draws, but not to its cell. The results outlive the runner.
    BenchRunner(std::filesystem::path program, std::filesystem::path work, Arguments drawOptions,
                ResultFile& results);

    // Runs a cell until it has `runs` results, earlier ones included. Stops at a failed run, which is
    // recorded in the results; an error means that results cannot be written.
    [[nodiscard]] base::Result<void> measure(const Cell& cell, int runs);

  private:
    // The JSON that the run printed.
    base::Result<nlohmann::json> runOnce(const Arguments& arguments) const;
    base::Result<void> prepare(const Cell& cell);

    std::filesystem::path program_, work_;
    Arguments drawOptions_;
    ResultFile& results_;
    std::set<std::string> prepared_;
};

}  // namespace terrane::app
