// Interrupts (Ctrl+C, kill) end the work between two frames, so that nothing unfinished stays behind.
#pragma once

namespace terrane::app {

// While one lives, these signals only make stopAsked() true. One at a time.
class StopSignals {
  public:
    StopSignals();
    ~StopSignals();  // they end the program again
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    bool stopAsked() const;
};

}  // namespace terrane::app
