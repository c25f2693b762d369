// Makes text of unknown origin safe for a terminal: names and values in files can hold escape sequences that
// change colors, titles or earlier output. Any thread may call.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

namespace terrane::base {

// The text as one line: control characters (also those of Unicode that reorder or break lines) and bytes that
// are not UTF-8 become \xNN for each byte.
[[nodiscard]] std::string printable(std::string_view text);

namespace detail {
void printLine(fmt::string_view format, fmt::format_args args);
}

// Prints a line of results to standard output, made printable.
template <class... Args>
void printLine(fmt::format_string<Args...> format, Args&&... args) {
    detail::printLine(format, fmt::make_format_args(args...));
}

}  // namespace terrane::base
