// What measurements were made on.
#pragma once

#include <nlohmann/json.hpp>

namespace terrane::app {

// Processor, memory, system, compiler: what does not change while the program runs.
nlohmann::json machineJson();

// Processes that ran or waited for a processor, as a mean over the last minute.
double loadAverage();

// Bytes a second at which this thread copies a block that no cache holds, the best of some times.
double memoryCopySpeed();

}  // namespace terrane::app
