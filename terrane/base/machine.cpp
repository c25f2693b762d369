#include "terrane/base/machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "terrane/base/platform.h"

namespace terrane::base {

Machine describeMachine() {
    return {.cpuName = platform::cpuName(),
            .system = platform::systemName(),
#ifdef __clang__
            .compiler = fmt::format("clang {}", __clang_version__),
#else
            .compiler = fmt::format("g++ {}", __VERSION__),
#endif
            .cpuCount = std::thread::hardware_concurrency(),
            .memoryBytes = platform::memoryBytes(),
#ifdef NDEBUG
            .hasAssertions = false};
#else
            .hasAssertions = true};
#endif
}

double loadAverage() {
    return platform::loadAverage();
}

double memoryCopySpeed() {
    const auto now = std::chrono::steady_clock::now;
    constexpr std::size_t kBytes = std::size_t{128} << 20;
    constexpr int kTimes = 8;
    std::vector<char> from(kBytes, 1), to(kBytes, 2);
    double best = 0;
    for (int k = 0; k < kTimes; ++k) {
        from[static_cast<std::size_t>(k)] = static_cast<char>(k);
        const auto start = now();
        std::memcpy(to.data(), from.data(), kBytes);
        const double seconds = std::chrono::duration<double>(now() - start).count();
        // Reads the copy, so that the compiler does not remove it.
        if (to[static_cast<std::size_t>(k)] == static_cast<char>(k))
            best = std::max(best, static_cast<double>(kBytes) / seconds);
    }
    return best;
}

std::size_t residentBytes() {
    return platform::residentBytes();
}

std::size_t peakResidentBytes() {
    return platform::peakResidentBytes();
}

double cpuSeconds() {
    return platform::cpuSeconds();
}

std::chrono::nanoseconds threadTime() {
    return platform::threadTime();
}

std::string machineName() {
    const std::string name = platform::hostName();
    return name.empty() ? "localhost" : name;
}

std::string processName() {
    return fmt::format("{} process {}", machineName(), platform::processNumber());
}

void raiseOpenFileLimit() {
    platform::raiseOpenFileLimit();
}

}  // namespace terrane::base
