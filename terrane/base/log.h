// Messages to the user who runs the program, one line each on standard error (standard output is for
// results), made printable (text.h). Any thread may call the functions; without memory a fixed line is
// written instead.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <utility>

namespace terrane::base {

enum class LogLevel {
    Info,     // "terrane: message"
    Warning,  // "terrane: warning: message"
    Error,    // "terrane: error: message"
    Silent,   // as a threshold: nothing is written
};

// Messages below the level are dropped before they are formatted. The initial level is Info.
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

// A progress bar on standard error; silent if that is not a terminal.
class ProgressBar {
  public:
    ProgressBar(std::string what, std::size_t total);
    ~ProgressBar();  // ends the line
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void set(std::size_t done);

  private:
    std::string what_;
    std::size_t total_;
    int shownPercent_ = -1;
    bool isTerminal_;
};

}  // namespace terrane::base
