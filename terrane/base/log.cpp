#include "terrane/base/log.h"

#include <spdlog/logger.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <cassert>
#include <cstdio>
#include <memory>
#include <new>
#include <string>

#include "terrane/base/printable.h"

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

std::unique_ptr<spdlog::logger> makeLogger() {
    auto made =
        std::make_unique<spdlog::logger>("terrane", std::make_shared<spdlog::sinks::stderr_sink_mt>());
    made->set_pattern("terrane: %v");
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

}  // namespace terrane::base
