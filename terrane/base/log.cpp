#include "terrane/base/log.h"

#include <spdlog/logger.h>
#include <spdlog/sinks/stdout_sinks.h>

#include <cassert>
#include <memory>
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
    const spdlog::level::level_enum target = spdlogLevel(level);
    if (!logger().should_log(target)) return;
    const char* word = level == LogLevel::Warning ? "warning: " : level == LogLevel::Error ? "error: " : "";
    // As one finished string: the message must not be read as a format again. Names and texts of files end up
    // in messages, so what a terminal would obey is escaped here, for all.
    const std::string line = word + printable(fmt::vformat(format, args));
    logger().log(target, spdlog::string_view_t(line));
}

}  // namespace detail

}  // namespace terrane::base
