// Text of unknown origin made safe for a terminal: names and values in files can hold escape sequences that
// change colors, titles or what was printed before. Any thread may call.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

namespace terrane::base {

// The text in one line: control characters (also those of Unicode that reorder or break lines) and bytes that
// are no UTF-8 become \xNN, a byte each. The rest stays.
[[nodiscard]] std::string printable(std::string_view text);

namespace detail {
void printLine(fmt::string_view format, fmt::format_args args);
}

// A line of results on standard output, made printable.
template <class... Args>
void printLine(fmt::format_string<Args...> format, Args&&... args) {
    detail::printLine(format, fmt::make_format_args(args...));
}

}  // namespace terrane::base
