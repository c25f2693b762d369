// Interrupts (Ctrl+C, kill, a terminal that closes) end the work between two frames: a game is saved, and
// nothing unfinished stays behind.
#pragma once

#include <array>
#include <csignal>

namespace terrane::base {

// While one lives, SIGINT, SIGTERM and SIGHUP only make stopAsked() true; SIGHUP not where it is ignored, as
// with nohup. One at a time.
class StopSignals {
  public:
    StopSignals();
    ~StopSignals();  // they do what they did before
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    bool stopAsked() const;

  private:
    static constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};

    std::array<void (*)(int), kSignals.size()> before_{};
};

}  // namespace terrane::base
