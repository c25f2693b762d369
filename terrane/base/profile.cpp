#include "terrane/base/profile.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <memory>
#include <mutex>
#include <string_view>
#include <utility>
#include <vector>

#include "terrane/base/files.h"
#include "terrane/base/log.h"

namespace terrane::base {

namespace {

struct ZoneRecord {
    const char* name;
    std::int64_t startNs;
    std::int64_t durationNs;
};

constexpr std::size_t kBlockZones = 4096;  // × 24 bytes = 96 KiB, allocated as the thread needs them
constexpr std::size_t kMaxBlocks = 256;    // × 96 KiB = 24 MiB for a thread
using ZoneBlock = std::array<ZoneRecord, kBlockZones>;
static_assert(sizeof(ZoneRecord) == 24);

// Written by its thread, read by writeTrace. The thread only appends within one trace and publishes with
// `count`; writeTrace reads a buffer only when `trace` is the current one, and no new trace can start
// meanwhile.
struct ThreadBuffer {
    std::array<std::unique_ptr<ZoneBlock>, kMaxBlocks> blocks;
    std::atomic<std::uint32_t> trace{0};
    std::atomic<std::size_t> count{0};
    std::atomic<std::size_t> droppedCount{0};
    unsigned threadNumber = 0;
    std::string threadName;  // guarded by Registry::mutex
};

struct Registry {
    std::mutex mutex;
    std::vector<std::shared_ptr<ThreadBuffer>> buffers;  // in the order in which threads appeared
    unsigned threadCount = 0;
    std::uint32_t lastTrace = 0;
    std::int64_t traceStartNs = 0;
};

Registry& registry() {
    static Registry instance;
    return instance;
}

// Drops the buffers of threads that have ended and that hold nothing of the last trace. Needs the lock.
void forgetEndedThreads(Registry& all) {
    std::erase_if(all.buffers, [&](const std::shared_ptr<ThreadBuffer>& buffer) {
        const bool isEmpty = buffer->trace != all.lastTrace || buffer->count == 0;
        return buffer.use_count() == 1 && isEmpty;
    });
}

std::shared_ptr<ThreadBuffer> addThread() {
    auto buffer = std::make_shared<ThreadBuffer>();
    Registry& all = registry();
    const std::lock_guard lock(all.mutex);
    forgetEndedThreads(all);
    buffer->threadNumber = ++all.threadCount;
    all.buffers.push_back(buffer);
    return buffer;
}

ThreadBuffer& threadBuffer() {
    thread_local const std::shared_ptr<ThreadBuffer> buffer = addThread();
    return *buffer;
}

// Quotes and escapes the text for JSON.
std::string jsonString(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (static_cast<unsigned char>(c) < 0x20) {
            out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
            continue;
        }
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + '"';
}

void appendThreadName(fmt::memory_buffer& out, const ThreadBuffer& buffer) {
    fmt::format_to(
        fmt::appender(out),
        ",\n{{\"name\":\"thread_name\",\"ph\":\"M\",\"pid\":1,\"tid\":{},\"args\":{{\"name\":{}}}}}",
        buffer.threadNumber, jsonString(buffer.threadName));
}

void appendZones(fmt::memory_buffer& out, const ThreadBuffer& buffer, std::int64_t traceStartNs) {
    const std::size_t count = buffer.count.load(std::memory_order_acquire);
    for (std::size_t i = 0; i < count; ++i) {
        const ZoneRecord& zone = (*buffer.blocks[i / kBlockZones])[i % kBlockZones];
        // A relaxed load may see the new trace before it starts: keep times from being negative.
        const std::int64_t startNs = std::max<std::int64_t>(zone.startNs - traceStartNs, 0);
        fmt::format_to(
            fmt::appender(out),
            ",\n{{\"name\":{},\"ph\":\"X\",\"ts\":{}.{:03},\"dur\":{}.{:03},\"pid\":1,\"tid\":{}}}",
            jsonString(zone.name), startNs / 1000, startNs % 1000, zone.durationNs / 1000,
            zone.durationNs % 1000, buffer.threadNumber);
    }
}

}  // namespace

void startTrace() {
    Registry& all = registry();
    const std::lock_guard lock(all.mutex);
    all.lastTrace += 1;
    forgetEndedThreads(all);
    all.traceStartNs = detail::nowNs();
    // Release pairs with the load in recordZone: a thread overwrites old records only after they were read.
    detail::activeTrace().store(all.lastTrace, std::memory_order_release);
}

void stopTrace() {
    detail::activeTrace().store(0, std::memory_order_release);
}

// Called when a thread starts: without memory the thread stays unnamed and works.
void setThreadName(std::string name) {
    try {
        ThreadBuffer& buffer = threadBuffer();
        const std::lock_guard lock(registry().mutex);
        buffer.threadName = std::move(name);
    } catch (const std::bad_alloc&) {
    }
}

Result<void> writeTrace(const std::filesystem::path& path) {
    fmt::memory_buffer out;
    out.append(std::string_view(
        "{\"displayTimeUnit\":\"ms\",\"traceEvents\":[\n"
        "{\"name\":\"process_name\",\"ph\":\"M\",\"pid\":1,\"args\":{\"name\":\"terrane\"}}"));
    std::size_t droppedCount = 0;
    {
        Registry& all = registry();
        const std::lock_guard lock(all.mutex);
        for (const std::shared_ptr<ThreadBuffer>& buffer : all.buffers) {
            if (!buffer->threadName.empty()) appendThreadName(out, *buffer);
            if (buffer->trace.load(std::memory_order_acquire) != all.lastTrace) continue;
            appendZones(out, *buffer, all.traceStartNs);
            droppedCount += buffer->droppedCount.load(std::memory_order_relaxed);
        }
    }
    out.append(std::string_view("\n]}\n"));
    if (droppedCount > 0)
        logWarning("{}: {} zones did not fit and are left out", path.string(), droppedCount);
    return writeFile(path, {out.data(), out.size()});
}

namespace detail {

std::int64_t nowNs() {
    const auto sinceEpoch = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(sinceEpoch).count();
}

void recordZone(const char* name, std::int64_t startNs, std::uint32_t trace) {
    const std::int64_t endNs = nowNs();
    assert(trace != 0 && "zones outside traces are not recorded");
    if (activeTrace().load(std::memory_order_acquire) != trace) return;
    ThreadBuffer& buffer = threadBuffer();
    if (buffer.trace.load(std::memory_order_relaxed) != trace) {
        buffer.count.store(0, std::memory_order_relaxed);
        buffer.droppedCount.store(0, std::memory_order_relaxed);
        buffer.trace.store(trace, std::memory_order_release);
    }
    const std::size_t index = buffer.count.load(std::memory_order_relaxed);
    if (index == kMaxBlocks * kBlockZones) {
        buffer.droppedCount.fetch_add(1, std::memory_order_relaxed);
        return;
    }
    std::unique_ptr<ZoneBlock>& block = buffer.blocks[index / kBlockZones];
    if (!block) block = std::make_unique<ZoneBlock>();
    (*block)[index % kBlockZones] = {name, startNs, endNs - startNs};
    buffer.count.store(index + 1, std::memory_order_release);
}

}  // namespace detail

}  // namespace terrane::base
