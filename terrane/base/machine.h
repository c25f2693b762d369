// Describes the machine that measurements are made on.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace terrane::base {

// Properties that do not change while the program runs.
struct Machine {
    std::string cpuName, system, compiler;
    unsigned cpuCount = 0;
    double memoryBytes = 0;
    bool hasAssertions = false;  // of this build
};
Machine describeMachine();

// Returns the mean number of processes that ran or waited for a CPU over the last minute.
double loadAverage();

// Returns the bytes per second at which this thread copies a block that fits no cache, as the best of several
// runs.
double memoryCopySpeed();

// These return the memory and CPU time that this process uses. Any thread may call them.
std::size_t residentBytes();      // 0 if unknown
std::size_t peakResidentBytes();  // so far
double cpuSeconds();              // of all threads, so far

// Returns the CPU time that the calling thread has used: what limits and measures work fairly on a busy
// machine.
std::chrono::nanoseconds threadTime();

// These name the machine and the process for people on other machines.
std::string machineName();  // "localhost" if it has no name
std::string processName();  // "mill process 123"

// Raises this process's limit on open files, and so on connections, to the hard limit, which needs no
// privileges.
void raiseOpenFileLimit();

constexpr double megabytes(std::size_t bytes) {
    return static_cast<double>(bytes) / 1e6;
}

}  // namespace terrane::base
