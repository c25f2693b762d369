// Memory and CPU time used by this process. Any thread.
#pragma once

#include <cstddef>

namespace terrane::base {

std::size_t residentBytes();      // 0 if unknown
std::size_t peakResidentBytes();  // so far
double cpuSeconds();              // of all threads, so far

constexpr double megabytes(std::size_t bytes) {
    return static_cast<double>(bytes) / 1e6;
}

}  // namespace terrane::base
