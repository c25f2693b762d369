// Profiling zones in the code, recorded while a trace runs and written for chrome://tracing and Perfetto.
//
//     void meshChunk() {
//         TERRANE_ZONE("mesh chunk");
//
// Any thread may call anything here. Each thread records into its own memory without a lock; a zone costs one
// relaxed load while no trace runs.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>

#include "terrane/base/result.h"

namespace terrane::base {

// Discards the previous trace and records the zones that begin from now on.
void startTrace();

// Stops recording. Zones that are still open are left out.
void stopTrace();

// Writes the running or the last trace as JSON: complete events in microseconds since its start, by thread. A
// thread records up to 1,048,576 zones (24 bytes each: 24 MiB); the number of dropped zones is logged.
[[nodiscard]] Result<void> writeTrace(const std::filesystem::path& path);

// Names the calling thread in traces, for example "worker 1".
void setThreadName(std::string name);

namespace detail {

// Returns the number of the running trace, 0 if none runs. A static in a function, so that the initialization
// order does not matter; constant initialization avoids a guard.
inline std::atomic<std::uint32_t>& activeTrace() {
    static constinit std::atomic<std::uint32_t> number{0};
    return number;
}

[[nodiscard]] std::int64_t nowNs();
void recordZone(const char* name, std::int64_t startNs, std::uint32_t trace);

}  // namespace detail

// TERRANE_ZONE creates it. The name must live as long as the program.
class ProfileZone {
  public:
    explicit ProfileZone(const char* name)
        : name_(name), trace_(detail::activeTrace().load(std::memory_order_relaxed)) {
        if (trace_ != 0) startNs_ = detail::nowNs();
    }
    ~ProfileZone() {
        if (trace_ != 0) detail::recordZone(name_, startNs_, trace_);
    }
    ProfileZone(const ProfileZone&) = delete;
    ProfileZone& operator=(const ProfileZone&) = delete;

  private:
    const char* name_;
    std::uint32_t trace_;  // the trace that ran when the zone began
    std::int64_t startNs_ = 0;
};

}  // namespace terrane::base

#define TERRANE_ZONE_JOIN2(a, b) a##b
#define TERRANE_ZONE_JOIN(a, b) TERRANE_ZONE_JOIN2(a, b)
// Marks the rest of the scope. The empty literals refuse anything but a string literal, whose memory is never
// freed.
#define TERRANE_ZONE(name) \
    const ::terrane::base::ProfileZone TERRANE_ZONE_JOIN(profileZone, __LINE__)("" name "")
