// Makes the measurements of the plan, each in a process of its own.
#pragma once

#include <set>

#include "apps/terrane/bench/bench_plan.h"
#include "apps/terrane/bench/result_file.h"

namespace terrane::app {

class BenchRunner {
  public:
    // `program`: this program's file. `work`: absolute; what runs need (saves, images) goes there. The
    // results outlive the runner.
    // `drawOptions`: given to each run that draws; cells do not name them.
    BenchRunner(std::filesystem::path program, std::filesystem::path work, int runs, Arguments drawOptions,
                ResultFile& results);

    // The runs that are missing. What goes wrong in a cell is kept with the results; an error where no run
    // can be made at all.
    [[nodiscard]] base::Result<void> measure(const Cell& cell);

  private:
    // What it printed as JSON, or why there is nothing.
    base::Result<nlohmann::json> runOnce(const Arguments& arguments) const;
    base::Result<void> prepare(const Cell& cell);

    std::filesystem::path program_, work_;
    int runs_;
    Arguments drawOptions_;
    ResultFile& results_;
    std::set<std::string> prepared_;
};

}  // namespace terrane::app
