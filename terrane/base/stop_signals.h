// Interrupts (Ctrl+C, kill, a closed terminal) end the program between two frames, so that a game is saved
// and no unfinished files are left.
#pragma once

#include <array>
#include <csignal>

namespace terrane::base {

// While an object exists, SIGINT, SIGTERM and SIGHUP only make stopAsked() true; SIGHUP stays ignored if it
// was, as with nohup. One object at a time.
class StopSignals {
  public:
    StopSignals();
    ~StopSignals();  // restores the former handlers
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    bool stopAsked() const;

  private:
    static constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};

    std::array<void (*)(int), kSignals.size()> before_{};
};

}  // namespace terrane::base
