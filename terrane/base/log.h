// Messages to the user who runs the program, one line each on standard error (standard output belongs to
// results), made printable (printable.h). Any thread may call.
#pragma once

#include <fmt/format.h>

#include <utility>

namespace terrane::base {

enum class LogLevel {
    Info,     // "terrane: message"
    Warning,  // "terrane: warning: message"
    Error,    // "terrane: error: message"
    Silent,   // as a threshold: nothing is written
};

// Messages below the level are dropped before they are formatted. Info at the start of the program.
void setLogLevel(LogLevel level);

namespace detail {
void writeLog(LogLevel level, fmt::string_view format, fmt::format_args args);
}

template <class... Args>
void logInfo(fmt::format_string<Args...> format, Args&&... args) {
    detail::writeLog(LogLevel::Info, format, fmt::make_format_args(args...));
}

template <class... Args>
void logWarning(fmt::format_string<Args...> format, Args&&... args) {
    detail::writeLog(LogLevel::Warning, format, fmt::make_format_args(args...));
}

template <class... Args>
void logError(fmt::format_string<Args...> format, Args&&... args) {
    detail::writeLog(LogLevel::Error, format, fmt::make_format_args(args...));
}

}  // namespace terrane::base
