// Statistics of a server for its owner and for load tests: a line of JSON every ten seconds.
#pragma once

#include <chrono>
#include <fstream>
#include <string>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/net/server/server.h"

namespace terrane::net {

class ServerStatistics {
  public:
    // An empty `file` disables the statistics.
    [[nodiscard]] static base::Result<ServerStatistics> open(const std::string& file);

    // Call after each tick with its duration.
    void addTick(const ServerCounts& counts, double milliseconds);

  private:
    void write(const ServerCounts& counts);

    std::ofstream out_;
    std::vector<double> ticks_;
    std::chrono::steady_clock::time_point next_{};
    double cpuSeconds_ = 0;
};

}  // namespace terrane::net
