// A progress bar on standard error; silent if that is not a terminal.
#pragma once

#include <cstddef>
#include <string>

namespace terrane::base {

class ProgressBar {
  public:
    ProgressBar(std::string what, std::size_t total);
    ~ProgressBar();  // ends the line
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void set(std::size_t done);

  private:
    std::string what_;
    std::size_t total_;
    int shownPercent_ = -1;
    bool isTerminal_;
};

}  // namespace terrane::base
