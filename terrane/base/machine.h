// What measurements were made on.
#pragma once

#include <string>

namespace terrane::base {

// What does not change while the program runs.
struct Machine {
    std::string processor, system, compiler;
    unsigned processors = 0;
    double memoryBytes = 0;
    bool hasAssertions = false;  // the build
};
Machine describeMachine();

// Processes that ran or waited for a processor, as a mean over the last minute.
double loadAverage();

// Bytes a second at which this thread copies a block that no cache holds, the best of some times.
double memoryCopySpeed();

}  // namespace terrane::base
