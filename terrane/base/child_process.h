// Runs another program to its end.
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
    std::chrono::seconds atMost{600};                                   // then it is killed
    std::vector<std::pair<std::string, std::string>> environment = {};  // variables besides one's own
    int mostRuns = 1;  // a child that crashes is run again until then
};

struct ChildEnd {
    int exitCode = 0;  // 128 + the signal that ended it
    int crashes = 0;  // runs that were ended by a fault of the program or of a driver (SIGSEGV, SIGABRT, …)
    bool tookTooLong = false;
    std::string output;                        // its standard output
    double seconds = 0, processorSeconds = 0;  // of the last run
};

// Waits. The child ends with the calling thread. For a process that has no other threads. An error where the
// system has no room for another process; a program that is not there or cannot be run gives exit code 127,
// as in a shell.
[[nodiscard]] Result<ChildEnd> runChild(const std::vector<std::string>& command, const ChildOptions& options);

}  // namespace terrane::base
