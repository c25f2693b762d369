#include "terrane/base/machine.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace terrane::base {

namespace {

// The value of `key` in a file of lines "key: value" or "key=value"; empty if there is none.
std::string lineOf(const char* path, const std::string& key) {
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line)) {
        if (!line.starts_with(key)) continue;
        const std::size_t start = line.find_first_not_of(" \t:=\"", key.size());
        const std::size_t end = line.find_last_not_of(" \t\"");
        if (start != std::string::npos) return line.substr(start, end - start + 1);
    }
    return {};
}

std::string systemName() {
    utsname names{};
    ::uname(&names);
    return fmt::format("{}, {} {}", lineOf("/etc/os-release", "PRETTY_NAME"), names.sysname, names.release);
}

double memoryBytes() {
    return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

Machine describeMachine() {
    return {.cpuName = lineOf("/proc/cpuinfo", "model name"),
            .system = systemName(),
#ifdef __clang__
            .compiler = fmt::format("clang {}", __clang_version__),
#else
            .compiler = fmt::format("g++ {}", __VERSION__),
#endif
            .cpuCount = std::thread::hardware_concurrency(),
            .memoryBytes = memoryBytes(),
#ifdef NDEBUG
            .hasAssertions = false};
#else
            .hasAssertions = true};
#endif
}

double loadAverage() {
    double load = 0;
    return ::getloadavg(&load, 1) == 1 ? load : 0;
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
    std::size_t total = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> total >> resident;
    return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

std::size_t peakResidentBytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

double cpuSeconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

std::chrono::nanoseconds threadTime() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

std::string machineName() {
    char name[256] = "";
    return ::gethostname(name, sizeof name - 1) == 0 && name[0] != '\0' ? name : "localhost";
}

std::string processName() {
    return fmt::format("{} process {}", machineName(), ::getpid());
}

void raiseOpenFileLimit() {
    rlimit limit{};
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
    limit.rlim_cur = limit.rlim_max;
    (void)setrlimit(RLIMIT_NOFILE, &limit);
}

}  // namespace terrane::base
