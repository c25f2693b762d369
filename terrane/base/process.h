// Runs another program and waits for its end.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "terrane/base/result.h"

namespace terrane::base {

struct ChildOptions {
    std::filesystem::path folder;                                       // working directory
    std::filesystem::path errorOutput;                                  // file for its standard error
    std::chrono::milliseconds timeout = std::chrono::minutes(10);       // the child is killed then
    std::vector<std::pair<std::string, std::string>> environment = {};  // added to the inherited variables
    int maxRuns = 1;  // a child that crashes is run again, up to this many runs
};

struct ChildResult {
    int exitCode = 0;  // 128 + the signal that ended it
    int crashes = 0;  // runs that were ended by a fault of the program or of a driver (SIGSEGV, SIGABRT, …)
    bool timedOut = false;
    std::string output = {};             // its standard output
    double seconds = 0, cpuSeconds = 0;  // of the last run
};

// Blocks until the child ends. The child is killed if the calling thread ends. Returns an error if the system
// cannot start another process; a program that is missing or cannot be run gives exit code 127, as in a
// shell.
[[nodiscard]] Result<ChildResult> runChild(const std::vector<std::string>& command,
                                           const ChildOptions& options);

// Interrupts (Ctrl+C, kill, a closed terminal) end the program between two frames, so that a game is saved
// and no unfinished files are left. While an object exists, SIGINT, SIGTERM and SIGHUP (on Windows Ctrl+C,
// Ctrl+Break and a closed console) only make stopRequested() return true; SIGHUP stays ignored if it was, as
// with nohup. One object at a time.
class StopSignals {
  public:
    StopSignals();
    ~StopSignals();  // restores the former handlers
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    bool stopRequested() const;
};

}  // namespace terrane::base
