#include "terrane/base/log.h"

#include <fmt/format.h>
#include <spdlog/logger.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/base_sink.h>

#include <cassert>
#include <cstdio>
#include <memory>
#include <mutex>
#include <new>
#include <string>

#include "terrane/base/platform.h"
#include "terrane/base/text.h"

namespace terrane::base {

namespace {

spdlog::level::level_enum spdlogLevel(LogLevel level) {
    switch (level) {
        case LogLevel::Info:
            return spdlog::level::info;
        case LogLevel::Warning:
            return spdlog::level::warn;
        case LogLevel::Error:
            return spdlog::level::err;
        case LogLevel::Silent:
            break;
    }
    return spdlog::level::off;
}

// spdlog's own keeps the handle that standard error has first, on Windows.
class StandardError : public spdlog::sinks::base_sink<std::mutex> {
    void sink_it_(const spdlog::details::log_msg& message) override {
        spdlog::memory_buf_t text;
        formatter_->format(message, text);
        std::fwrite(text.data(), 1, text.size(), stderr);
    }
    void flush_() override { std::fflush(stderr); }
};

std::unique_ptr<spdlog::logger> makeLogger() {
    auto made = std::make_unique<spdlog::logger>("terrane", std::make_shared<StandardError>());
    made->set_formatter(std::make_unique<spdlog::pattern_formatter>(
        "terrane: %v", spdlog::pattern_time_type::local, "\n"));  // the same bytes on all systems
    return made;
}

spdlog::logger& logger() {
    static const std::unique_ptr<spdlog::logger> instance = makeLogger();
    return *instance;
}

}  // namespace

void setLogLevel(LogLevel level) {
    logger().set_level(spdlogLevel(level));
}

namespace detail {

void writeLog(LogLevel level, fmt::string_view format, fmt::format_args args) {
    assert(level != LogLevel::Silent && "Silent is a threshold, not a kind of message");
    try {
        const spdlog::level::level_enum target = spdlogLevel(level);
        if (!logger().should_log(target)) return;
        const char* word = level == LogLevel::Warning ? "warning: "
                           : level == LogLevel::Error ? "error: "
                                                      : "";
        // Passed as one finished string, so that the message is not parsed as a format again. Messages
        // contain names and texts of files, so terminal control characters are escaped here for all messages.
        const std::string line = word + printable(fmt::vformat(format, args));
        logger().log(target, spdlog::string_view_t(line));
    } catch (const std::bad_alloc&) {
        std::fputs("terrane: no memory for a message\n", stderr);
    }
}

}  // namespace detail

ProgressBar::ProgressBar(std::string what, std::size_t total)
    : what_(std::move(what)), total_(total), isTerminal_(platform::isTerminal(2)) {
    set(0);
}

ProgressBar::~ProgressBar() {
    if (isTerminal_) fmt::print(stderr, "\n");
}

void ProgressBar::set(std::size_t done) {
    const int percent = total_ == 0 ? 100 : static_cast<int>(100 * done / total_);
    if (!isTerminal_ || percent == shownPercent_) return;
    shownPercent_ = percent;
    constexpr int kWidth = 40;
    const int filled = percent * kWidth / 100;
    fmt::print(stderr, "\r{} [{:=<{}}{:{}}] {:3}%", what_, "", filled, "", kWidth - filled, percent);
    std::fflush(stderr);
}

}  // namespace terrane::base
