// Writes statistics of each frame to a CSV file, for plots: a line per frame, a column per value.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>

#include "apps/terrane/window/hud/overlay.h"

namespace terrane::app {

class PerfLog {
  public:
    static base::Result<PerfLog> create(const std::filesystem::path& file);

    // `seconds`: since the start; `frameSeconds`: duration of the frame.
    void add(double seconds, double frameSeconds, const Statistics& statistics);
    // Fails if something could not be written.
    base::Result<void> finish();

  private:
    explicit PerfLog(const std::filesystem::path& file) : path_(file), out_(file) {}

    std::filesystem::path path_;
    std::ofstream out_;
    std::vector<stream::TaskTime> tasks_;  // as of the last frame
};

}  // namespace terrane::app
