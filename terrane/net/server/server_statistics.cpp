#include "terrane/net/server/server_statistics.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "terrane/base/log.h"
#include "terrane/base/machine.h"
#include "terrane/base/statistics.h"

namespace terrane::net {
namespace {

constexpr std::chrono::seconds kEvery{10};

}  // namespace

base::Result<ServerStatistics> ServerStatistics::open(const std::string& file) {
    ServerStatistics statistics;
    if (file.empty()) return statistics;
    statistics.out_.open(file, std::ios::app);
    if (!statistics.out_) return base::fail(base::ErrorCode::Io, "{}: cannot be written", file);
    return statistics;
}

void ServerStatistics::addTick(const ServerCounts& counts, double milliseconds) {
    if (!out_.is_open()) return;
    ticks_.push_back(milliseconds);
    const auto now = std::chrono::steady_clock::now();
    if (next_ == std::chrono::steady_clock::time_point()) next_ = now + kEvery;
    if (now < next_) return;
    next_ += kEvery;
    write(counts);
}

void ServerStatistics::write(const ServerCounts& counts) {
    const double cpu = base::cpuSeconds();
    const nlohmann::json line = {{"players", counts.players},
                                 {"ticks", ticks_.size()},
                                 {"tick_ms_median", base::quantileOf(ticks_, 0.5)},
                                 {"tick_ms_p99", base::quantileOf(ticks_, 0.99)},
                                 {"tick_ms_max", std::ranges::max(ticks_)},
                                 {"cpu_seconds", cpu - cpuSeconds_},
                                 {"memory_mb", base::megabytes(base::residentBytes())},
                                 {"chunks", counts.loadedChunks},
                                 {"edited_chunks", counts.editedChunks},
                                 {"edits", counts.edits}};
    const bool wasGood = out_.good();
    out_ << line.dump() << std::endl;
    if (wasGood && !out_) base::logWarning("the statistics cannot be written any more");
    cpuSeconds_ = cpu;
    ticks_.clear();
}

}  // namespace terrane::net
